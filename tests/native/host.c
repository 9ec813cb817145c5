/* A host for the damper's FMU in plain C: host LIBRARY speed N | state SEED | threads N | abuse | forged | leak

   Ends with 1 and a message where something is not as it must be. */
#include <pthread.h>
#include <time.h>
#include <unistd.h>

#include "fmu.h"

#include "forged.h"
#include "values.h"

#define RUN 4000 /* steps of an instance in a thread */

struct run {
    int number;
    enum set which;
    uint64_t sum; /* of the bytes of all outputs of all steps */
};

static uint64_t randomness;

static uint64_t drawn(uint64_t below)
{
    randomness = randomness * 6364136223846793005u + 1442695040888963407u;
    return (randomness >> 33) % below;
}

/* [kB] of memory in use. */
static long resident(void)
{
    long all = 0, used = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    CHECK(file != NULL && fscanf(file, "%ld %ld", &all, &used) == 2, "no /proc/self/statm");
    fclose(file);
    return used * (sysconf(_SC_PAGESIZE) / 1024);
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Time [ns] of a step with its inputs and the force to stdout, growth of the memory [kB] to stderr. */
static void speed(long n)
{
    static double moved[PERIOD][2];
    const fmi2ValueReference force = reference("force");
    struct instance i;
    double total = 0.0, begun = 0.0, F;
    long before = resident(); /* the first time, its own memory grows */
    for (long k = 0; k < PERIOD; k++)
        motion(k, moved[k]);
    started(&i, DEGRADED, 0.56);
    for (long k = -PERIOD; k < n; k++) {
        if (k == 0) {
            before = resident();
            begun = now();
        }
        if (fmu.SetReal(i.c, MOTION, 2, moved[(k + PERIOD) % PERIOD]) != fmi2OK
            || fmu.DoStep(i.c, (double)(k + PERIOD) * STEP, STEP, fmi2True) != fmi2OK
            || fmu.GetReal(i.c, &force, 1, &F) != fmi2OK)
            CHECK(0, "step %ld: %s", k, i.text);
        total += F;
    }
    begun = now() - begun;
    before = resident() - before;
    CHECK(total - total == 0.0, "the sum of the forces is %g", total);
    printf("%.1f\n", 1e9 * begun / (double)n);
    fprintf(stderr, "%ld\n", before);
    fmu.FreeInstance(i.c);
}

/* The outputs of the steps `from` to `to`. */
static void record(struct instance *i, long from, long to, double *values)
{
    for (long k = from; k < to; k++) {
        step(i, k);
        CHECK(get_outputs(i, values + (size_t)(k - from) * outputs) == fmi2OK, "%s", i->text);
    }
}

static void carry_on(enum set which)
{
    static double first[300 * 32], again[300 * 32];
    const long from = (long)drawn(2000), to = from + 300;
    const long other = (long)drawn(100);
    const double tuned = (double)drawn(1000) * 1e-3;
    struct instance a, b;
    fmi2FMUstate kept = NULL, second = NULL, moved = NULL;
    fmi2Byte *bytes, *twin;
    size_t size = 0;

    started(&a, which, 0.56);
    started(&b, drawn(2) ? DEGRADED : INTACT, 0.9);
    for (long k = 0; k < from; k++)
        step(&a, k);
    for (long k = 0; k < other; k++)
        step(&b, k);
    /* A parameter that waits for the next step and an input derivative belong to the state too. */
    if (drawn(2))
        CHECK(set(&a, reference("degradation.X_Re"), tuned) == fmi2OK, "%s", a.text);
    CHECK(fmu.SetRealInputDerivatives(a.c, &MOTION[1], 1, orders, &tuned) == fmi2OK, "%s", a.text);
    CHECK(fmu.GetFMUstate(a.c, &kept) == fmi2OK && fmu.SerializedFMUstateSize(a.c, kept, &size) == fmi2OK, "%s", a.text);
    record(&a, from, to, first);
    CHECK(fmu.SetFMUstate(a.c, kept) == fmi2OK, "%s", a.text);
    record(&a, from, to, again);
    CHECK(memcmp(first, again, sizeof first) == 0, "set %d from step %ld: not the same after a restored state", which, from);

    bytes = malloc(size), twin = malloc(size);
    CHECK(fmu.SerializeFMUstate(a.c, kept, bytes, size) == fmi2OK, "%s", a.text);
    CHECK(fmu.DeSerializeFMUstate(b.c, bytes, size, &moved) == fmi2OK, "%s", b.text);
    CHECK(fmu.SetFMUstate(b.c, moved) == fmi2OK, "%s", b.text);
    CHECK(fmu.GetFMUstate(b.c, &second) == fmi2OK && fmu.SerializeFMUstate(b.c, second, twin, size) == fmi2OK, "%s", b.text);
    CHECK(memcmp(bytes, twin, size) == 0, "equal states have different bytes");
    fmu.FreeFMUstate(a.c, &kept);
    fmu.FreeInstance(a.c);
    record(&b, from, to, again);
    CHECK(memcmp(first, again, sizeof first) == 0, "set %d from step %ld: not the same in another instance", which, from);
    CHECK(fmu.FreeFMUstate(b.c, &second) == fmi2OK && fmu.FreeFMUstate(b.c, &moved) == fmi2OK && !moved, "%s", b.text);
    fmu.FreeInstance(b.c);
    free(bytes), free(twin);
}

/* A state kept before the first step brings the mode back with it. */
static void start_again(enum set which)
{
    static double first[300 * 32], again[300 * 32];
    struct instance i;
    fmi2FMUstate kept = NULL;
    open_instance(&i);
    set_up(&i, which, 0.56);
    CHECK(fmu.SetupExperiment(i.c, fmi2False, 0.0, 0.0, fmi2False, 0.0) == fmi2OK, "%s", i.text);
    CHECK(fmu.EnterInitializationMode(i.c) == fmi2OK && fmu.GetFMUstate(i.c, &kept) == fmi2OK, "%s", i.text);
    CHECK(fmu.ExitInitializationMode(i.c) == fmi2OK, "%s", i.text);
    record(&i, 0, 300, first);
    CHECK(fmu.Terminate(i.c) == fmi2OK && fmu.SetFMUstate(i.c, kept) == fmi2OK, "%s", i.text);
    CHECK(fmu.DoStep(i.c, 0.0, STEP, fmi2True) == fmi2Error, "a step within the initialization");
    CHECK(fmu.ExitInitializationMode(i.c) == fmi2OK, "%s", i.text);
    record(&i, 0, 300, again);
    CHECK(memcmp(first, again, sizeof first) == 0, "not the same from the initialization on");
    fmu.FreeFMUstate(i.c, &kept);
    fmu.FreeInstance(i.c);
}

static void state(long seed)
{
    randomness = (uint64_t)seed;
    for (int k = 0; k < 30; k++)
        carry_on(k % 3);
    for (int which = INTACT; which <= EXTENDED; which++)
        start_again(which);
    CHECK(blocks == 0, "%ld blocks are not freed", blocks);
}

static void *driven(void *data)
{
    struct run *run = data;
    struct instance i;
    double values[32];
    started(&i, run->which, 0.5 + 0.5 / (1 + run->number));
    run->sum = 14695981039346656037u;
    for (long k = 0; k < RUN; k++) {
        step(&i, k);
        CHECK(get_outputs(&i, values) == fmi2OK, "%s", i.text);
        for (size_t b = 0; b < outputs * sizeof(double); b++)
            run->sum = (run->sum ^ ((unsigned char *)values)[b]) * 1099511628211u;
    }
    fmu.FreeInstance(i.c);
    return NULL;
}

static void threads(int n)
{
    struct run *alone = calloc((size_t)n, sizeof *alone), *together = calloc((size_t)n, sizeof *together);
    pthread_t *thread = calloc((size_t)n, sizeof *thread);
    for (int k = 0; k < n; k++) {
        alone[k].number = together[k].number = k;
        alone[k].which = together[k].which = k % 2 ? EXTENDED : DEGRADED;
        driven(&alone[k]);
    }
    for (int k = 0; k < n; k++)
        CHECK(pthread_create(&thread[k], NULL, driven, &together[k]) == 0, "no thread");
    for (int k = 0; k < n; k++)
        CHECK(pthread_join(thread[k], NULL) == 0, "no end of a thread");
    for (int k = 0; k < n; k++) {
        CHECK(alone[k].sum == together[k].sum, "instance %d: not the same beside other threads", k);
        CHECK(k < 2 || alone[k].sum != alone[k - 2].sum, "instances %d and %d: the same with other parameters", k, k - 2);
    }
    CHECK(blocks == 0, "%ld blocks are not freed", blocks);
    free(alone), free(together), free(thread);
}

static void leak(void)
{
    for (int k = 0; k < 2000; k++) {
        struct instance i;
        fmi2FMUstate kept = NULL, other = NULL;
        fmi2Byte *bytes;
        size_t size = 0;
        started(&i, k % 3, 0.56);
        for (int n = 0; n < 3; n++)
            CHECK(fmu.GetFMUstate(i.c, &kept) == fmi2OK, "%s", i.text);
        CHECK(blocks == 3, "%ld blocks: an instance, its name and one state were wanted", blocks);
        CHECK(fmu.SerializedFMUstateSize(i.c, kept, &size) == fmi2OK, "%s", i.text);
        bytes = malloc(size);
        CHECK(fmu.SerializeFMUstate(i.c, kept, bytes, size) == fmi2OK, "%s", i.text);
        for (int n = 0; n < 3; n++)
            CHECK(fmu.DeSerializeFMUstate(i.c, bytes, size, &other) == fmi2OK, "%s", i.text);
        free(bytes);
        CHECK(fmu.FreeFMUstate(i.c, &kept) == fmi2OK && kept == NULL, "%s", i.text);
        CHECK(fmu.FreeFMUstate(i.c, &kept) == fmi2OK && fmu.FreeFMUstate(i.c, NULL) == fmi2OK, "%s", i.text);
        CHECK(fmu.FreeFMUstate(i.c, &other) == fmi2OK && blocks == 2, "%ld blocks", blocks);
        CHECK(fmu.Reset(i.c) == fmi2OK && blocks == 2, "%ld blocks", blocks);
        fmu.FreeInstance(i.c);
        CHECK(blocks == 0, "%ld blocks are not freed", blocks);
    }
}

int main(int n, char **argument)
{
    const char *command = n > 2 ? argument[2] : "";
    const long number = n > 3 ? atol(argument[3]) : 0;
    CHECK(n > 2, "host LIBRARY speed N | state SEED | threads N | abuse | forged | leak");
    load(argument[1]);
    if (!strcmp(command, "speed") && number > 0)
        speed(number);
    else if (!strcmp(command, "state"))
        state(number);
    else if (!strcmp(command, "threads") && number > 0)
        threads((int)number);
    else if (!strcmp(command, "abuse"))
        abuse();
    else if (!strcmp(command, "forged"))
        forged_states();
    else if (!strcmp(command, "leak"))
        leak();
    else
        CHECK(0, "no command %s", command);
    return 0;
}

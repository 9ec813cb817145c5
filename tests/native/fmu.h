/* What the programs of this folder share: an FMU's functions, instances that count their messages, parameter sets, motion.

   The functions come from a shared library, or with STATIC from the sources that are linked to the program. */
#ifndef FMU_H
#define FMU_H

#include "fmi2Functions.h"
#include "unit.h" /* the table of variables */

#ifndef STATIC
#include <dlfcn.h>
#endif

#define STEP (6.283185307179586 / 6284) /* [s] 6284 steps are one period of the motion */
#define PERIOD 6284

#define CHECK(condition, ...)                                                          \
    do {                                                                               \
        if (!(condition)) {                                                            \
            fprintf(stderr, "%s:%d: not so: %s: ", __FILE__, __LINE__, #condition);    \
            fprintf(stderr, __VA_ARGS__);                                              \
            fprintf(stderr, "\n");                                                     \
            exit(1);                                                                   \
        }                                                                              \
    } while (0)

#define FUNCTIONS(X)                                                                                                     \
    X(GetTypesPlatform) X(GetVersion) X(SetDebugLogging) X(Instantiate) X(FreeInstance) X(SetupExperiment)               \
    X(EnterInitializationMode) X(ExitInitializationMode) X(Terminate) X(Reset) X(GetReal) X(GetInteger) X(GetBoolean)    \
    X(GetString) X(SetReal) X(SetInteger) X(SetBoolean) X(SetString) X(GetFMUstate) X(SetFMUstate) X(FreeFMUstate)       \
    X(SerializedFMUstateSize) X(SerializeFMUstate) X(DeSerializeFMUstate) X(GetDirectionalDerivative)                    \
    X(SetRealInputDerivatives) X(GetRealOutputDerivatives) X(DoStep) X(CancelStep) X(GetStatus) X(GetRealStatus)         \
    X(GetIntegerStatus) X(GetBooleanStatus) X(GetStringStatus)

#define POINTER(name) fmi2##name##TYPE *name;
static struct { FUNCTIONS(POINTER) } fmu;

enum set { INTACT, DEGRADED, EXTENDED }; /* the last with all effects active */

static const fmi2ValueReference MOTION[] = {0, 1};

struct instance {
    fmi2Component c;
    fmi2CallbackFunctions functions;
    int messages;
    char text[1024]; /* the last message */
    fmi2Status said; /* its status */
};

/* All that can be asked for; outputs only where they can be computed. */
struct picture {
    fmi2Status status;
    double value[sizeof VARIABLE / sizeof VARIABLE[0]];
    double time;
};

static long blocks;          /* allocated and not yet freed */
static long room = -1;       /* so many allocations still succeed; -1: all */
static fmi2ValueReference output[32];
static size_t outputs;

static void load(const char *library)
{
#ifdef STATIC
    (void)library;
#define TAKE(name) fmu.name = fmi2##name;
#else
    void *handle = dlopen(library, RTLD_NOW | RTLD_LOCAL);
    CHECK(handle != NULL, "%s", dlerror());
#define TAKE(name)                                  \
    *(void **)&fmu.name = dlsym(handle, "fmi2" #name); \
    CHECK(fmu.name != NULL, "fmi2" #name " is missing");
#endif
    FUNCTIONS(TAKE)
    for (fmi2ValueReference i = 0; i < VARIABLES; i++) {
        if (VARIABLE[i].causality == OUTPUT)
            output[outputs++] = i;
    }
}

/* Reads the message as importers do: as a format. */
static void log_message(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category,
                        fmi2String message, ...)
{
    struct instance *i = environment;
    va_list arguments;
    CHECK(name != NULL && category != NULL && *message, "incomplete message");
    CHECK(status >= fmi2Warning && status <= fmi2Error, "status %d", (int)status);
    va_start(arguments, message);
    vsnprintf(i->text, sizeof i->text, message, arguments);
    va_end(arguments);
    CHECK(!strpbrk(message, "%#"), "%s", message);
    i->said = status;
    i->messages++;
}

static void *allocate(size_t n, size_t size)
{
    if (room == 0)
        return NULL;
    if (room > 0)
        room--;
    __sync_fetch_and_add(&blocks, 1);
    return calloc(n, size);
}

static void release(void *memory)
{
    if (memory != NULL)
        __sync_fetch_and_sub(&blocks, 1);
    free(memory);
}

static void open_instance(struct instance *i)
{
    const fmi2CallbackFunctions functions = {log_message, allocate, release, NULL, i};
    memset(i, 0, sizeof *i);
    i->functions = functions;
    i->c = fmu.Instantiate("damper", fmi2CoSimulation, VALUES.guid, NULL, &i->functions, fmi2False, fmi2False);
    CHECK(i->c != NULL, "%s", i->text);
}

static fmi2ValueReference reference(const char *name)
{
    fmi2ValueReference vr = 0;
    while (vr < VARIABLES && strcmp(VARIABLE[vr].name, name))
        vr++;
    CHECK(vr < VARIABLES, "no variable %s", name);
    return vr;
}

static fmi2Status set(struct instance *i, fmi2ValueReference vr, double value)
{
    const int whole = VARIABLE[vr].kind == INTEGER ? (int)value : 0;
    return VARIABLE[vr].kind == INTEGER ? fmu.SetInteger(i->c, &vr, 1, &whole) : fmu.SetReal(i->c, &vr, 1, &value);
}

/* An effect's parameter, which makes it active: fixed, bounded and 0 at the start. */
static int activates(fmi2ValueReference vr)
{
    const struct variable *v = &VARIABLE[vr];
    const int bounded = v->kind == REAL && v->max < INFINITY && strncmp(v->name, "geometry.", 9);
    return v->causality == FIXED && bounded && VALUES.start[vr] == 0.0;
}

static void set_up(struct instance *i, enum set which, double oil)
{
    if (which == INTACT)
        return;
    CHECK(set(i, reference("oil_level"), oil) == fmi2OK && set(i, reference("gas_preload"), 0) == fmi2OK, "%s", i->text);
    for (fmi2ValueReference vr = 0; which == EXTENDED && vr < VARIABLES; vr++) {
        if (activates(vr))
            CHECK(set(i, vr, 0.1 * VARIABLE[vr].max) == fmi2OK, "%s", i->text);
    }
}

static void begin_steps(struct instance *i)
{
    CHECK(fmu.SetupExperiment(i->c, fmi2False, 0.0, 0.0, fmi2False, 0.0) == fmi2OK, "%s", i->text);
    CHECK(fmu.EnterInitializationMode(i->c) == fmi2OK, "%s", i->text);
    CHECK(fmu.ExitInitializationMode(i->c) == fmi2OK, "%s", i->text);
}

static void started(struct instance *i, enum set which, double oil)
{
    open_instance(i);
    set_up(i, which, oil);
    begin_steps(i);
}

static void motion(long k, double *stroke_and_velocity)
{
    const double t = (double)(k % PERIOD) * STEP;
    stroke_and_velocity[0] = 0.04 * sin(30 * t) + 0.01 * sin(7 * t);
    stroke_and_velocity[1] = 1.2 * cos(30 * t) + 0.07 * cos(7 * t);
}

/* The k-th step. */
static void step(struct instance *i, long k)
{
    double moved[2];
    motion(k, moved);
    CHECK(fmu.SetReal(i->c, MOTION, 2, moved) == fmi2OK, "%s", i->text);
    CHECK(fmu.DoStep(i->c, (double)k * STEP, STEP, fmi2True) <= fmi2Warning, "step %ld: %s", k, i->text);
}

static fmi2Status get_outputs(struct instance *i, double *values)
{
    return fmu.GetReal(i->c, output, outputs, values);
}

/* Whether the outputs can be those of a damper. */
static int sound(struct instance *i)
{
    double values[32];
    CHECK(get_outputs(i, values) == fmi2OK, "%s", i->text);
    for (size_t k = 0; k < outputs; k++) {
        const struct variable *v = &VARIABLE[output[k]];
        if (!(values[k] - values[k] == 0.0) || values[k] < v->min - 1e-12 || values[k] > v->max) {
            fprintf(stderr, "%s = %g%s\n", v->name, values[k], v->unit);
            return 0;
        }
    }
    return 1;
}

/* Serialized states: bytes before the memory, and where among them its size and its sum are. */
#define HEADER 80
#define SIZE_AT 64
#define SUM_AT 72

/* Give bytes the sum of a state, as anybody can. */
static void sign(fmi2Byte *bytes, size_t size)
{
    uint64_t sum = 14695981039346656037u;
    for (size_t k = HEADER; k < size; k++)
        sum = (sum ^ (unsigned char)bytes[k]) * 1099511628211u;
    memcpy(bytes + SUM_AT, &sum, sizeof sum);
}

static struct picture taken(struct instance *i)
{
    const int messages = i->messages;
    struct picture p;
    double values[32];
    memset(&p, 0, sizeof p);
    for (fmi2ValueReference vr = 0; vr < VARIABLES; vr++) {
        int whole = 0;
        if (VARIABLE[vr].kind == INTEGER) {
            CHECK(fmu.GetInteger(i->c, &vr, 1, &whole) == fmi2OK, "%s", i->text);
            p.value[vr] = whole;
        } else if (VARIABLE[vr].causality != OUTPUT) {
            CHECK(fmu.GetReal(i->c, &vr, 1, &p.value[vr]) == fmi2OK, "%s", i->text);
        }
    }
    p.status = get_outputs(i, values);
    for (size_t k = 0; k < outputs && p.status == fmi2OK; k++)
        p.value[output[k]] = values[k];
    CHECK(fmu.GetRealStatus(i->c, fmi2LastSuccessfulTime, &p.time) == fmi2OK, "%s", i->text);
    i->messages = messages;
    return p;
}

static int same(const struct picture *a, const struct picture *b)
{
    return memcmp(a, b, sizeof *a) == 0;
}

#endif

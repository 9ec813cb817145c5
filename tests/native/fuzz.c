/* Random calls, right and wrong, of all functions on several instances: fuzz ROUNDS SEED plain|extended

   After every call: what is refused was said and changed nothing, what is accepted gives outputs that can be those of a
   damper, and after a refused step an instance goes on as one that was never asked for it. Else it ends with 1. */
#include <limits.h>

#include "draws.h"
#include "fmu.h"

#define SLOTS 3
#define STATES 3

struct slot {
    struct instance i;
    fmi2FMUstate state[STATES];
    double z, v; /* of a motion that is possible */
};

static struct slot slots[SLOTS];
static struct instance twin;
static long calls, steps, refused, uncomputed;
static enum set which;

static void judge(struct slot *s, const struct picture *before, int messages, fmi2Status status, const char *call)
{
    struct picture after;
    calls++;
    CHECK(status <= fmi2Error, "%s: status %d", call, (int)status);
    if (status <= fmi2Warning) {
        CHECK(status == fmi2OK || s->i.messages > messages, "%s: a warning without a message", call);
        return;
    }
    after = taken(&s->i);
    refused++;
    CHECK(s->i.messages > messages, "%s: refused without a message", call);
    CHECK(same(before, &after), "%s: changed though refused: %s", call, s->i.text);
    uncomputed += strstr(s->i.text, "could not be computed") != NULL;
}

/* To be used with a slot `s`, a picture `before` and a `status`. */
#define TRY(call)                                          \
    do {                                                   \
        const int messages = s->i.messages;                \
        before = taken(&s->i);                             \
        status = (call);                                   \
        judge(s, &before, messages, status, #call);        \
    } while (0)

static void fresh(struct slot *s)
{
    open_instance(&s->i);
    set_up(&s->i, DEGRADED, uniform(0.4, 1.0));
    for (fmi2ValueReference vr = 0; which == EXTENDED && vr < VARIABLES; vr++) {
        if (activates(vr) && drawn(4))
            CHECK(set(&s->i, vr, VARIABLE[vr].max * (drawn(8) ? uniform(0.0, 0.3) : 1.0)) == fmi2OK, "%s", s->i.text);
    }
    s->z = s->v = 0.0;
}

static void renewed(struct slot *s)
{
    const fmi2CallbackFunctions *f = &s->i.functions;
    for (int k = 0; k < STATES; k++)
        CHECK(fmu.FreeFMUstate(s->i.c, &s->state[k]) == fmi2OK, "%s", s->i.text);
    fmu.FreeInstance(s->i.c);
    s->i.messages = 0;
    s->i.c = fmu.Instantiate(drawn(3) ? "x" : "", (fmi2Type)drawn(3), drawn(3) ? VALUES.guid : "", NULL, f, 0, 1);
    CHECK(s->i.c != NULL || s->i.messages == 1, "no instance and %d messages", s->i.messages);
    fmu.FreeInstance(s->i.c);
    fresh(s);
}

/* The same step by the instance and by its twin, which takes the state from before the refused step. */
static void compared(struct slot *s, fmi2FMUstate before_step)
{
    const fmi2Integer first = 1;
    const double none = 0.0;
    double moved[2] = {s->z, drawn(2) ? 0.3 : 0.0}, time, mine[32], other[32];
    fmi2Status status;
    CHECK(fmu.SetFMUstate(twin.c, before_step) == fmi2OK, "%s", twin.text);
    /* An attempt uses up the input derivative. */
    CHECK(fmu.SetRealInputDerivatives(twin.c, &MOTION[1], 1, &first, &none) == fmi2OK, "%s", twin.text);
    CHECK(fmu.SetReal(s->i.c, MOTION, 2, moved) == fmi2OK, "%s", s->i.text);
    CHECK(fmu.SetReal(twin.c, MOTION, 2, moved) == fmi2OK, "%s", twin.text);
    CHECK(fmu.GetRealStatus(s->i.c, fmi2LastSuccessfulTime, &time) == fmi2OK, "%s", s->i.text);
    status = fmu.DoStep(s->i.c, time, 1e-3, fmi2True);
    CHECK(status == fmu.DoStep(twin.c, time, 1e-3, fmi2True), "another status after a refused step");
    CHECK(get_outputs(&s->i, mine) == fmi2OK && get_outputs(&twin, other) == fmi2OK, "%s", s->i.text);
    CHECK(memcmp(mine, other, outputs * sizeof *mine) == 0, "goes on in another way after a refused step");
    if (status <= fmi2Warning)
        s->z += moved[1] * 1e-3;
}

static void step_of(struct slot *s, double time, double h)
{
    struct picture before;
    fmi2Status status;
    fmi2FMUstate kept = NULL;
    CHECK(fmu.GetFMUstate(s->i.c, &kept) == fmi2OK, "%s", s->i.text);
    TRY(fmu.DoStep(s->i.c, time, h, (fmi2Boolean)drawn(2)));
    steps += status <= fmi2Warning;
    if (status <= fmi2Warning)
        CHECK(sound(&s->i), "after a step of %g s", h);
    else if (before.status == fmi2OK && drawn(4) == 0 && fmu.SetReal(s->i.c, &MOTION[0], 1, &s->z) == fmi2OK)
        compared(s, kept);
    CHECK(fmu.FreeFMUstate(s->i.c, &kept) == fmi2OK, "%s", s->i.text);
}

/* A step as an importer makes it. */
static void right_step(struct slot *s)
{
    static const double size[] = {1e-4, 1e-3, 1e-3, 1e-3, 5e-3, 0.0, 1e-9, 1e-16, 2e-2};
    const double h = size[drawn(sizeof size / sizeof *size)];
    double time, moved[2];
    s->v = drawn(50) ? 0.95 * s->v + uniform(-0.2, 0.2) : drawn(3) ? uniform(-3.0, 3.0) : 0.0;
    if (fabs(s->z + s->v * h) > 0.08)
        s->v = s->z > 0.0 ? -fabs(s->v) : fabs(s->v);
    if (fabs(s->z + s->v * h) > 0.09)
        s->v = 0.0;
    moved[0] = s->z, moved[1] = s->v;
    if (fmu.SetReal(s->i.c, MOTION, 2, moved) != fmi2OK)
        return;
    CHECK(fmu.GetRealStatus(s->i.c, fmi2LastSuccessfulTime, &time) == fmi2OK, "%s", s->i.text);
    step_of(s, time + uniform(-1e-10, 1e-10), h);
    s->z += s->v * h;
}

static void forward(struct slot *s)
{
    struct picture before;
    fmi2Status status;
    if (drawn(2))
        TRY(fmu.SetupExperiment(s->i.c, drawn(2) == 0, any_number(), drawn(4) ? 0.0 : any_number(), drawn(8) == 0, 100.0));
    TRY(fmu.EnterInitializationMode(s->i.c));
    TRY(fmu.ExitInitializationMode(s->i.c));
    if (status == fmi2OK)
        CHECK(sound(&s->i), "at the start");
    else if (before.status != fmi2OK)
        renewed(s); /* parameters that do not go together */
}

static void values(struct slot *s)
{
    struct picture before;
    fmi2Status status;
    fmi2ValueReference refs[8];
    fmi2Integer whole[8], order[8];
    fmi2Boolean flags[8];
    fmi2String strings[8] = {0};
    double reals[8];
    const size_t n = drawn(4) ? 1 : drawn(9);
    for (size_t k = 0; k < 8; k++) {
        refs[k] = any_reference();
        reals[k] = number_for(refs[k]);
        whole[k] = drawn(8) ? (int)drawn(4) - 1 : drawn(2) ? INT_MAX : INT_MIN;
        order[k] = drawn(4) ? 1 : (int)drawn(4) - 1;
    }
    switch (drawn(14)) {
    case 0: case 1: case 2: TRY(fmu.SetReal(s->i.c, drawn(30) ? refs : NULL, n, drawn(30) ? reals : NULL)); break;
    case 3: case 4: TRY(fmu.SetInteger(s->i.c, drawn(30) ? refs : NULL, n, drawn(30) ? whole : NULL)); break;
    case 5: TRY(fmu.GetReal(s->i.c, drawn(30) ? refs : NULL, n, drawn(30) ? reals : NULL)); break;
    case 6: TRY(fmu.GetInteger(s->i.c, drawn(30) ? refs : NULL, n, drawn(30) ? whole : NULL)); break;
    case 7: TRY(fmu.GetBoolean(s->i.c, refs, n, flags)); break;
    case 8: TRY(fmu.GetString(s->i.c, refs, n, strings)); break;
    case 9: TRY(fmu.SetBoolean(s->i.c, refs, n, whole)); break;
    case 10: TRY(fmu.SetString(s->i.c, refs, n, strings)); break;
    case 11: TRY(fmu.SetRealInputDerivatives(s->i.c, refs, n, drawn(30) ? order : NULL, drawn(30) ? reals : NULL)); break;
    case 12: TRY(fmu.GetRealOutputDerivatives(s->i.c, refs, n, order, reals)); break;
    default: TRY(fmu.GetDirectionalDerivative(s->i.c, refs, n, refs, n, reals, reals));
    }
}

/* A state with changed bytes and the right sum: refused, or its instance goes on with numbers. */
static void forged(const fmi2Byte *bytes, size_t size)
{
    static fmi2Byte copy[16384];
    fmi2FMUstate state = NULL;
    const double moved[2] = {0.0, uniform(-1.0, 1.0)};
    double number, values[32], time;
    memcpy(copy, bytes, size);
    for (uint64_t k = 0; k <= drawn(3); k++) {
        const size_t at = HEADER + drawn((size - HEADER) / 8) * 8;
        number = any_number();
        if (drawn(3))
            memcpy(copy + at, &number, sizeof number);
        else
            copy[at + drawn(8)] ^= (fmi2Byte)(1 << drawn(8));
    }
    sign(copy, size);
    calls++;
    if (fmu.DeSerializeFMUstate(twin.c, copy, size, &state) != fmi2OK) {
        CHECK(state == NULL, "a state of refused bytes");
        refused++;
        return;
    }
    CHECK(fmu.SetFMUstate(twin.c, state) == fmi2OK && fmu.FreeFMUstate(twin.c, &state) == fmi2OK, "%s", twin.text);
    fmu.SetReal(twin.c, MOTION, 2, moved);
    for (int k = 0; k < 3; k++) {
        CHECK(fmu.GetRealStatus(twin.c, fmi2LastSuccessfulTime, &time) == fmi2OK, "%s", twin.text);
        fmu.DoStep(twin.c, time, 1e-3, fmi2True);
        if (get_outputs(&twin, values) == fmi2OK) {
            for (size_t i = 0; i < outputs; i++)
                CHECK(values[i] - values[i] == 0.0, "%s = %g after a forged state", VARIABLE[output[i]].name, values[i]);
        }
    }
}

/* States go from instance to instance as bytes, some of them broken. */
static void kept(struct slot *s)
{
    static fmi2Byte bytes[16384];
    fmi2FMUstate *state = &s->state[drawn(STATES)];
    struct picture before;
    fmi2Status status;
    size_t size = sizeof bytes;
    switch (drawn(6)) {
    case 0: TRY(fmu.GetFMUstate(s->i.c, drawn(30) ? state : NULL)); break;
    case 1: TRY(fmu.FreeFMUstate(s->i.c, drawn(30) ? state : NULL)); break;
    case 2: TRY(fmu.SetFMUstate(s->i.c, *state)); break;
    case 3: TRY(fmu.SerializedFMUstateSize(s->i.c, *state, drawn(30) ? &size : NULL)); break;
    default:
        TRY(fmu.SerializeFMUstate(s->i.c, *state, bytes, drawn(4) ? sizeof bytes : drawn(sizeof bytes)));
        if (status == fmi2OK && fmu.SerializedFMUstateSize(s->i.c, *state, &size) == fmi2OK)
            forged(bytes, size);
        size = sizeof bytes;
        if (drawn(4) == 0)
            bytes[drawn(4000)] ^= (fmi2Byte)(1 << drawn(8));
        s = &slots[drawn(SLOTS)];
        state = &s->state[drawn(STATES)];
        TRY(fmu.DeSerializeFMUstate(s->i.c, drawn(30) ? bytes : NULL, drawn(4) ? size : drawn(size), state));
    }
    CHECK(fmu.GetReal(s->i.c, MOTION, 1, &s->z) == fmi2OK, "%s", s->i.text);
    if (fabs(s->z) > 0.08)
        s->z = 0.0;
}

static void other(struct slot *s)
{
    const fmi2String category[] = {"logStatusError", "logStatusWarning", "logAll", NULL, "%s%n"};
    const fmi2StatusKind kind = (fmi2StatusKind)drawn(6);
    struct picture before;
    fmi2Status status, value;
    fmi2Integer whole;
    fmi2String text;
    double real;
    switch (drawn(14)) {
    case 0: TRY(fmu.SetupExperiment(s->i.c, fmi2True, any_number(), any_number(), drawn(2) == 0, any_number())); break;
    case 1: TRY(fmu.EnterInitializationMode(s->i.c)); break;
    case 2: TRY(fmu.ExitInitializationMode(s->i.c)); break;
    case 3: if (drawn(20) == 0) TRY(fmu.Terminate(s->i.c)); break;
    case 4: if (drawn(20) == 0) TRY(fmu.Reset(s->i.c)); break;
    case 5: if (drawn(20) == 0) renewed(s); break;
    case 6: TRY(fmu.CancelStep(s->i.c)); break;
    case 7: TRY(fmu.GetStatus(s->i.c, kind, &value)); break;
    case 8: TRY(fmu.GetRealStatus(s->i.c, kind, drawn(9) ? &real : NULL)); break;
    case 9: TRY(fmu.GetIntegerStatus(s->i.c, kind, &whole)); break;
    case 10: TRY(fmu.GetBooleanStatus(s->i.c, kind, drawn(9) ? &whole : NULL)); break;
    case 11: TRY(fmu.GetStringStatus(s->i.c, kind, &text)); break;
    case 12: TRY(fmu.SetDebugLogging(s->i.c, (fmi2Boolean)drawn(2), drawn(2), &category[drawn(5)])); break;
    default: step_of(s, any_number(), any_number());
    }
    CHECK(fmu.SetDebugLogging(s->i.c, fmi2True, 0, NULL) == fmi2OK, "%s", s->i.text);
}

int main(int n, char **argument)
{
    const long rounds = n > 1 ? atol(argument[1]) : 1000;
    randomness = n > 2 ? strtoull(argument[2], NULL, 10) * 2 + 1 : 1;
    which = n > 3 && !strcmp(argument[3], "extended") ? EXTENDED : DEGRADED;
    load(NULL);
    open_instance(&twin);
    for (int k = 0; k < SLOTS; k++)
        fresh(&slots[k]);
    for (long k = 0; k < rounds; k++) {
        struct slot *s = &slots[drawn(SLOTS)];
        const uint64_t kind = drawn(20);
        if (kind < 13)
            right_step(s);
        else if (kind < 15)
            values(s);
        else if (kind < 17)
            kept(s);
        else if (kind < 19)
            other(s);
        else
            (drawn(30) ? forward : renewed)(s);
    }
    for (int k = 0; k < SLOTS; k++) {
        renewed(&slots[k]); /* frees its states */
        fmu.FreeInstance(slots[k].i.c);
    }
    fmu.FreeInstance(twin.c);
    CHECK(blocks == 0, "%ld blocks are not freed", blocks);
    printf("%ld calls, %ld steps, %ld refused, %ld of them not computed\n", calls, steps, refused, uncomputed);
    return 0;
}

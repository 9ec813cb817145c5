/* Random calls, right and wrong, of all functions of FMI 3.0 on several instances: fuzz3 ROUNDS SEED plain|extended

   After every call: what is refused was said and changed nothing, what is accepted gives outputs that can be those of a
   damper. Else it ends with 1. */

#include "draws.h"
#include "fmu3.h"

#define SLOTS 3

static struct slot slots[SLOTS];
static int extended;

/* An effect's parameter, which makes it active: fixed, bounded and 0 at the start. */
static int activates(const struct variable *v)
{
    const int bounded = v->kind == REAL && v->max < INFINITY && strncmp(v->name, "geometry.", 9);
    return v->causality == FIXED && bounded && VALUES.start[v - VARIABLE] == 0.0;
}

static fmi3Instance instantiated(struct slot *s, fmi3String name, fmi3String token, fmi3Boolean events, size_t required)
{
    static const fmi3ValueReference force = 2;
    return fmi3InstantiateCoSimulation(name, token, NULL, fmi3False, fmi3True, events, drawn(2) != 0, &force, required, s,
                                       listen_to, NULL);
}

static void fresh(struct slot *s)
{
    s->c = instantiated(s, "damper", VALUES.guid, fmi3False, 0);
    CHECK(s->c != NULL, "%s", s->text);
    for (unsigned vr = 0; vr < VARIABLES; vr++) {
        const double value = VARIABLE[vr].max * (drawn(8) ? uniform(0.0, 0.3) : 1.0);
        if (extended && activates(&VARIABLE[vr]) && drawn(4))
            CHECK(fmi3SetFloat64(s->c, &vr, 1, &value, 1) == fmi3OK, "%s", s->text);
    }
    s->z = s->v = s->time = 0.0;
}

static void renewed(struct slot *s)
{
    fmi3Instance c;
    const int wrong = (int)drawn(6);
    for (int k = 0; k < STATES; k++)
        CHECK(fmi3FreeFMUState(s->c, &s->state[k]) == fmi3OK, "%s", s->text);
    fmi3FreeInstance(s->c);
    s->messages = 0;
    c = instantiated(s, wrong == 1 ? "" : wrong == 2 ? NULL : "x", wrong == 3 ? "%s%n" : VALUES.guid, wrong == 4, wrong == 5);
    CHECK((c != NULL) == (wrong == 0) && s->messages == (wrong != 0), "%d: %s", wrong, s->text);
    fmi3FreeInstance(c);
    fresh(s);
}

static void step_of(struct slot *s, double time, double h)
{
    struct picture before;
    fmi3Status status;
    fmi3Boolean event = fmi3True, ends = fmi3True, early = fmi3True;
    double last = NAN, *reached = drawn(99) ? &last : NULL;
    TRY(fmi3DoStep(s->c, time, h, fmi3True, drawn(99) ? &event : NULL, &ends, &early, reached));
    if (status > fmi3Warning)
        return;
    CHECK(!event && !ends && !early && last == time + h, "reached %g s", last);
    steps++;
    s->time = last;
    check_sound(s);
}

/* A step as an importer makes it. */
static void right_step(struct slot *s)
{
    static const double size[] = {1e-4, 1e-3, 1e-3, 1e-3, 5e-3, 0.0, 1e-9, 1e-16, 2e-2};
    const double h = size[drawn(sizeof size / sizeof *size)];
    const fmi3ValueReference motion[] = {0, 1};
    double moved[2];
    s->v = drawn(50) ? 0.95 * s->v + uniform(-0.2, 0.2) : drawn(3) ? uniform(-3.0, 3.0) : 0.0;
    if (fabs(s->z + s->v * h) > 0.08)
        s->v = s->z > 0.0 ? -fabs(s->v) : fabs(s->v);
    if (fabs(s->z + s->v * h) > 0.09)
        s->v = 0.0;
    moved[0] = s->z, moved[1] = s->v;
    if (fmi3SetFloat64(s->c, motion, 2, moved, 2) != fmi3OK)
        return;
    step_of(s, s->time + uniform(-1e-10, 1e-10), h);
    s->z += s->v * h;
}

/* Stroke and time as the unit has them; the time is the last variable. */
static void follow_up(struct slot *s)
{
    const fmi3ValueReference asked[] = {0, VARIABLES - 1};
    double found[2];
    CHECK(fmi3GetFloat64(s->c, asked, 2, found, 2) == fmi3OK, "%s", s->text);
    s->z = fabs(found[0]) > 0.08 ? 0.0 : found[0];
    s->time = found[1];
}

static void values(struct slot *s)
{
    struct picture before;
    fmi3Status status;
    fmi3ValueReference refs[4];
    double reals[MOST];
    fmi3Int32 whole[MOST];
    const size_t n = drawn(4) ? 1 : drawn(5);
    size_t wanted = 0, many;
    for (size_t i = 0; i < n; i++) {
        refs[i] = any_reference();
        for (size_t k = 0; refs[i] < VARIABLES && k < VARIABLE[refs[i]].length; k++, wanted++) {
            reals[wanted] = number_for(refs[i] + (unsigned)k);
            whole[wanted] = drawn(8) ? (int)drawn(4) - 1 : drawn(2) ? INT_MAX : INT_MIN;
        }
    }
    many = drawn(20) ? wanted : drawn(3);
    for (size_t k = wanted; k < 4; k++)
        reals[k] = 0.0, whole[k] = 0;
    switch (drawn(5)) {
    case 0: TRY(fmi3SetInt32(s->c, drawn(30) ? refs : NULL, n, drawn(30) ? whole : NULL, many)); break;
    case 1: TRY(fmi3GetInt32(s->c, drawn(30) ? refs : NULL, n, drawn(30) ? whole : NULL, many)); break;
    case 2: TRY(fmi3GetFloat64(s->c, drawn(30) ? refs : NULL, n, drawn(30) ? reals : NULL, many)); break;
    default: TRY(fmi3SetFloat64(s->c, drawn(30) ? refs : NULL, n, drawn(30) ? reals : NULL, many));
    }
    CHECK(status != fmi3OK || many == wanted, "%zu values accepted for %zu", many, wanted);
    follow_up(s);
}

/* States go from instance to instance as bytes, some of them broken. */
static void kept(struct slot *s)
{
    static fmi3Byte bytes[ROOM];
    fmi3FMUState *state = &s->state[drawn(STATES)];
    struct picture before;
    fmi3Status status;
    size_t size = ROOM;
    switch (drawn(6)) {
    case 0: TRY(fmi3GetFMUState(s->c, drawn(30) ? state : NULL)); break;
    case 1: TRY(fmi3FreeFMUState(s->c, drawn(30) ? state : NULL)); break;
    case 2: TRY(fmi3SetFMUState(s->c, *state)); break;
    case 3: TRY(fmi3SerializedFMUStateSize(s->c, *state, drawn(30) ? &size : NULL)); break;
    default:
        TRY(fmi3SerializeFMUState(s->c, *state, bytes, drawn(4) ? ROOM : drawn(ROOM)));
        if (status == fmi3OK)
            CHECK(fmi3SerializedFMUStateSize(s->c, *state, &size) == fmi3OK, "%s", s->text);
        if (drawn(4) == 0)
            bytes[drawn(4000)] ^= (fmi3Byte)(1 << drawn(8));
        s = &slots[drawn(SLOTS)];
        TRY(fmi3DeserializeFMUState(s->c, drawn(30) ? bytes : NULL, drawn(4) ? size : drawn(size), &s->state[drawn(STATES)]));
    }
    follow_up(s);
}

static void forward(struct slot *s)
{
    const double start = drawn(4) ? 0.0 : any_number();
    struct picture before;
    fmi3Status status;
    TRY(fmi3EnterInitializationMode(s->c, drawn(2) != 0, any_number(), start, drawn(8) == 0, 100.0));
    if (status == fmi3OK)
        s->time = start;
    TRY(fmi3ExitInitializationMode(s->c));
    if (status == fmi3OK)
        check_sound(s);
    else if (before.status != fmi3OK)
        renewed(s); /* parameters that do not go together */
}

#include "fuzz3_absent.h"

static void other(struct slot *s)
{
    const fmi3String category[] = {"logStatusError", "logStatusWarning", "logAll", NULL, "%s%n"};
    struct picture before;
    fmi3Status status;
    switch (drawn(8)) {
    case 0: TRY(fmi3ExitInitializationMode(s->c)); break;
    case 1: if (drawn(20) == 0) TRY(fmi3Terminate(s->c)); break;
    case 2: if (drawn(20) == 0) TRY(fmi3Reset(s->c)); break;
    case 3: if (drawn(20) == 0) renewed(s); break;
    case 4: TRY(fmi3SetDebugLogging(s->c, drawn(2) != 0, drawn(2), &category[drawn(5)])); break;
    case 5: step_of(s, any_number(), any_number()); break;
    default: TRY(absent(s->c));
    }
    CHECK(fmi3SetDebugLogging(s->c, fmi3True, 0, NULL) == fmi3OK, "%s", s->text);
    follow_up(s);
}

int main(int n, char **argument)
{
    const long rounds = n > 1 ? atol(argument[1]) : 1000;
    randomness = n > 2 ? strtoull(argument[2], NULL, 10) * 2 + 1 : 1;
    extended = n > 3 && !strcmp(argument[3], "extended");
    for (unsigned vr = 0; vr < VARIABLES; vr++) {
        if (VARIABLE[vr].causality == OUTPUT)
            output[outputs++] = vr;
    }
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
        fmi3FreeInstance(slots[k].c);
    }
    printf("%ld calls, %ld steps, %ld refused\n", calls, steps, refusals);
    return 0;
}

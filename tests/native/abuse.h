/* Calls that must be refused: with a status, with a message, and with nothing changed. */
#ifndef ABUSE_H
#define ABUSE_H

#include <limits.h>

#include "fmu.h"

static fmi2ValueReference refs[2] = {0, 1};
static fmi2Integer orders[2] = {1, 1}, whole[2];
static double reals[2];
static fmi2Boolean flags[2];
static fmi2String strings[2] = {"", ""};
static size_t bytes_needed;
static fmi2Byte serialized[16384];
static fmi2FMUstate saved;

/* Calls that are right in some mode. */
#define RIGHT(name, ...)                                 \
    static fmi2Status right_##name(fmi2Component c)      \
    {                                                    \
        return fmu.name(c, __VA_ARGS__);                 \
    }
RIGHT(SetDebugLogging, fmi2True, 0, NULL)
RIGHT(SetupExperiment, fmi2True, 1e-6, 0.0, fmi2True, 10.0)
RIGHT(GetReal, refs, 2, reals)
RIGHT(GetInteger, refs, 0, whole)
RIGHT(GetBoolean, refs, 0, flags)
RIGHT(GetString, refs, 0, strings)
RIGHT(SetReal, refs, 2, (const double[]){0.0, 0.0})
RIGHT(SetInteger, refs, 0, whole)
RIGHT(SetBoolean, refs, 0, flags)
RIGHT(SetString, refs, 0, strings)
RIGHT(GetFMUstate, &saved)
RIGHT(SetFMUstate, saved)
RIGHT(SerializedFMUstateSize, saved, &bytes_needed)
RIGHT(SerializeFMUstate, saved, serialized, sizeof serialized)
RIGHT(DeSerializeFMUstate, serialized, sizeof serialized, &saved)
RIGHT(FreeFMUstate, &saved)
RIGHT(GetDirectionalDerivative, refs, 0, refs, 0, reals, reals)
RIGHT(SetRealInputDerivatives, refs, 2, orders, (const double[]){0.0, 0.0})
RIGHT(GetRealOutputDerivatives, refs, 0, orders, reals)
RIGHT(GetRealStatus, fmi2LastSuccessfulTime, reals)
RIGHT(GetBooleanStatus, fmi2Terminated, flags)
RIGHT(GetStatus, fmi2DoStepStatus, (fmi2Status[]){fmi2OK})
RIGHT(GetIntegerStatus, fmi2DoStepStatus, whole)
RIGHT(GetStringStatus, fmi2PendingStatus, strings)
RIGHT(DoStep, 0.0, 1e-3, fmi2True)

static fmi2Status right_CancelStep(fmi2Component c)
{
    return fmu.CancelStep(c);
}

#define FIRST (1 << INSTANTIATED)
#define SECOND (1 << INITIALIZING)
#define THIRD (1 << STEPPING)
#define LAST (1 << TERMINATED)
#define ALWAYS (FIRST | SECOND | THIRD | LAST)

/* Those without a function here change the mode. */
static const struct {
    const char *name;
    fmi2Status (*call)(fmi2Component);
    int modes; /* where it is right */
    fmi2Status refusal;
} RIGHT_CALL[] = {
#define ROW(name, modes, refusal) {#name, right_##name, modes, refusal}
    ROW(SetDebugLogging, ALWAYS, fmi2Error), ROW(SetupExperiment, FIRST, fmi2Error), ROW(GetReal, ALWAYS, fmi2Error),
    ROW(GetInteger, ALWAYS, fmi2Error), ROW(GetBoolean, ALWAYS, fmi2Error), ROW(GetString, ALWAYS, fmi2Error),
    ROW(SetReal, ALWAYS & ~LAST, fmi2Error), ROW(SetInteger, ALWAYS & ~LAST, fmi2Error), ROW(SetBoolean, ALWAYS, fmi2Error),
    ROW(SetString, ALWAYS, fmi2Error), ROW(GetFMUstate, ALWAYS, fmi2Error), ROW(SetFMUstate, ALWAYS, fmi2Error),
    ROW(SerializedFMUstateSize, ALWAYS, fmi2Error), ROW(SerializeFMUstate, ALWAYS, fmi2Error),
    ROW(DeSerializeFMUstate, ALWAYS, fmi2Error), ROW(FreeFMUstate, ALWAYS, fmi2Error),
    ROW(GetDirectionalDerivative, ALWAYS, fmi2Error), ROW(SetRealInputDerivatives, ALWAYS & ~LAST, fmi2Error),
    ROW(GetRealOutputDerivatives, ALWAYS, fmi2Error), ROW(GetRealStatus, ALWAYS, fmi2Error),
    ROW(GetBooleanStatus, ALWAYS, fmi2Error), ROW(GetStatus, 0, fmi2Discard), ROW(GetIntegerStatus, 0, fmi2Discard),
    ROW(GetStringStatus, 0, fmi2Discard), ROW(DoStep, THIRD, fmi2Error), ROW(CancelStep, 0, fmi2Error),
    {"EnterInitializationMode", NULL, FIRST, fmi2Error}, {"ExitInitializationMode", NULL, SECOND, fmi2Error},
    {"Terminate", NULL, THIRD, fmi2Error},
};

static fmi2Status called(size_t k, fmi2Component c)
{
    const char *name = RIGHT_CALL[k].name;
    if (RIGHT_CALL[k].call != NULL)
        return RIGHT_CALL[k].call(c);
    return *name == 'T' ? fmu.Terminate(c) : name[1] == 'n' ? fmu.EnterInitializationMode(c) : fmu.ExitInitializationMode(c);
}

static void opened_in(struct instance *i, enum set which, int mode)
{
    open_instance(i);
    set_up(i, which, 0.56);
    if (mode >= INITIALIZING) {
        CHECK(fmu.SetupExperiment(i->c, fmi2False, 0.0, 0.0, fmi2True, 10.0) == fmi2OK, "%s", i->text);
        CHECK(fmu.EnterInitializationMode(i->c) == fmi2OK, "%s", i->text);
    }
    if (mode >= STEPPING)
        CHECK(fmu.ExitInitializationMode(i->c) == fmi2OK, "%s", i->text);
    if (mode == TERMINATED)
        CHECK(fmu.Terminate(i->c) == fmi2OK, "%s", i->text);
}

static void orders_of_calls(void)
{
    for (int mode = INSTANTIATED; mode <= TERMINATED; mode++) {
        for (size_t k = 0; k < sizeof RIGHT_CALL / sizeof RIGHT_CALL[0]; k++) {
            struct instance i;
            struct picture before, after;
            fmi2Status status;
            opened_in(&i, DEGRADED, mode);
            CHECK(fmu.GetFMUstate(i.c, &saved) == fmi2OK, "%s", i.text);
            CHECK(fmu.SerializeFMUstate(i.c, saved, serialized, sizeof serialized) == fmi2OK, "%s", i.text);
            before = taken(&i);
            status = called(k, i.c);
            if (RIGHT_CALL[k].modes >> mode & 1) {
                CHECK(status == fmi2OK && i.messages == 0, "%s in mode %d: %s", RIGHT_CALL[k].name, mode, i.text);
            } else {
                after = taken(&i);
                CHECK(status == RIGHT_CALL[k].refusal, "%s in mode %d: %d", RIGHT_CALL[k].name, mode, status);
                CHECK(i.messages == 1, "%s in mode %d: %d messages", RIGHT_CALL[k].name, mode, i.messages);
                CHECK(same(&before, &after), "%s in mode %d", RIGHT_CALL[k].name, mode);
            }
            CHECK(called(k, NULL) == fmi2Error, "%s without a component", RIGHT_CALL[k].name);
            fmu.FreeFMUstate(i.c, &saved);
            fmu.FreeInstance(i.c);
        }
    }
    CHECK(fmu.Reset(NULL) == fmi2Error, "Reset without a component");
    fmu.FreeInstance(NULL);
}

/* To be called with an instance `i` and a picture `before`. */
#define REFUSED(status, call)                                                             \
    do {                                                                                  \
        const int messages = i.messages;                                                  \
        CHECK((call) == (status), "another status");                                      \
        CHECK(i.messages == messages + 1, "%d messages", i.messages - messages);          \
        CHECK(i.said == (status), "said with another status");                            \
        after = taken(&i);                                                                \
        CHECK(same(&before, &after), "changed");                                          \
    } while (0)

static void arguments(int mode)
{
    const fmi2ValueReference force = reference("force"), oil = reference("oil_level"), venting = reference("reading.venting");
    const fmi2ValueReference mixed[2] = {oil, VARIABLES}, wrong = 4294967295u;
    const double half = 0.5, none = 0.0, values[2] = {0.5, 0.5};
    const fmi2String category[2] = {"logStatusError", "%s%n#r0#"}, nothing = NULL;
    struct instance i;
    struct picture before, after;
    fmi2FMUstate state = NULL, other = NULL;
    size_t size = 0;
    opened_in(&i, DEGRADED, mode);
    before = taken(&i);

    REFUSED(fmi2Error, fmu.SetReal(i.c, NULL, 1, &half));
    REFUSED(fmi2Error, fmu.SetReal(i.c, &oil, 1, NULL));
    REFUSED(fmi2Error, fmu.SetReal(i.c, &wrong, 1, &half));
    REFUSED(fmi2Error, fmu.SetReal(i.c, mixed, 2, values)); /* nor is the first one set */
    REFUSED(fmi2Error, fmu.SetReal(i.c, &venting, 1, &half));
    REFUSED(fmi2Error, fmu.SetReal(i.c, &force, 1, &half));
    REFUSED(fmi2Error, fmu.SetInteger(i.c, NULL, 1, whole));
    REFUSED(fmi2Error, fmu.SetInteger(i.c, &venting, 1, NULL));
    REFUSED(fmi2Error, fmu.SetInteger(i.c, &oil, 1, whole));
    REFUSED(fmi2Error, fmu.SetInteger(i.c, &wrong, 1, whole));
    if (mode == STEPPING) {
        REFUSED(fmi2Error, fmu.DoStep(i.c, 0.0, 11.0, fmi2True)); /* it is to stop at 10 s */
        REFUSED(fmi2Error, fmu.SetReal(i.c, &oil, 1, &half));
        REFUSED(fmi2Error, fmu.SetInteger(i.c, &venting, 1, whole));
    }
    REFUSED(fmi2Error, fmu.SetBoolean(i.c, &oil, 1, flags));
    REFUSED(fmi2Error, fmu.SetString(i.c, &oil, 1, strings));
    REFUSED(fmi2Error, fmu.GetBoolean(i.c, &oil, 1, flags));
    REFUSED(fmi2Error, fmu.GetString(i.c, &oil, 1, strings));
    REFUSED(fmi2Error, fmu.GetReal(i.c, NULL, 1, reals));
    REFUSED(fmi2Error, fmu.GetReal(i.c, &oil, 1, NULL));
    REFUSED(fmi2Error, fmu.GetReal(i.c, &venting, 1, reals));
    REFUSED(fmi2Error, fmu.GetReal(i.c, &wrong, 1, reals));
    REFUSED(fmi2Error, fmu.GetInteger(i.c, NULL, 1, whole));
    REFUSED(fmi2Error, fmu.GetInteger(i.c, &venting, 1, NULL));
    REFUSED(fmi2Error, fmu.GetInteger(i.c, &oil, 1, whole));
    REFUSED(fmi2Error, fmu.GetInteger(i.c, &wrong, 1, whole));
    CHECK(fmu.SetReal(i.c, NULL, 0, NULL) == fmi2OK && fmu.GetReal(i.c, NULL, 0, NULL) == fmi2OK, "%s", i.text);
    CHECK(fmu.SetInteger(i.c, NULL, 0, NULL) == fmi2OK && fmu.GetInteger(i.c, NULL, 0, NULL) == fmi2OK, "%s", i.text);

    CHECK(fmu.SetRealInputDerivatives(i.c, NULL, 0, NULL, NULL) == fmi2OK, "%s", i.text);
    REFUSED(fmi2Error, fmu.SetRealInputDerivatives(i.c, refs, 2, NULL, values));
    REFUSED(fmi2Error, fmu.SetRealInputDerivatives(i.c, refs, 2, (const int[]){1, 2}, values));
    REFUSED(fmi2Error, fmu.SetRealInputDerivatives(i.c, &oil, 1, orders, values));
    REFUSED(fmi2Error, fmu.SetRealInputDerivatives(i.c, refs, 1, orders, (const double[]){NAN}));
    REFUSED(fmi2Error, fmu.GetRealOutputDerivatives(i.c, &force, 1, orders, reals));
    REFUSED(fmi2Error, fmu.GetDirectionalDerivative(i.c, &force, 1, refs, 1, &none, reals));
    REFUSED(fmi2Error, fmu.GetRealStatus(i.c, fmi2LastSuccessfulTime, NULL));
    REFUSED(fmi2Discard, fmu.GetRealStatus(i.c, fmi2DoStepStatus, reals));
    REFUSED(fmi2Error, fmu.GetBooleanStatus(i.c, fmi2Terminated, NULL));
    REFUSED(fmi2Discard, fmu.GetBooleanStatus(i.c, fmi2PendingStatus, flags));

    REFUSED(fmi2Error, fmu.SetDebugLogging(i.c, fmi2False, 2, category));
    REFUSED(fmi2Error, fmu.SetDebugLogging(i.c, fmi2False, 1, &nothing));
    REFUSED(fmi2Error, fmu.SetDebugLogging(i.c, fmi2False, 1, NULL));
    CHECK(fmu.SetDebugLogging(i.c, fmi2False, 1, category) == fmi2OK && fmu.Terminate(NULL) == fmi2Error, "%s", i.text);
    size = (size_t)i.messages;
    CHECK(fmu.SetReal(i.c, &wrong, 1, &half) == fmi2Error && (size_t)i.messages == size, "said though turned off");
    CHECK(fmu.SetDebugLogging(i.c, fmi2True, 0, NULL) == fmi2OK, "%s", i.text);

    REFUSED(fmi2Error, fmu.GetFMUstate(i.c, NULL));
    REFUSED(fmi2Error, fmu.SetFMUstate(i.c, NULL));
    CHECK(fmu.GetFMUstate(i.c, &state) == fmi2OK && fmu.SerializedFMUstateSize(i.c, state, &size) == fmi2OK, "%s", i.text);
    CHECK(size <= sizeof serialized, "%zu bytes", size);
    REFUSED(fmi2Error, fmu.SerializedFMUstateSize(i.c, NULL, &size));
    REFUSED(fmi2Error, fmu.SerializedFMUstateSize(i.c, state, NULL));
    REFUSED(fmi2Error, fmu.SerializeFMUstate(i.c, state, serialized, size - 1));
    REFUSED(fmi2Error, fmu.SerializeFMUstate(i.c, state, NULL, size));
    REFUSED(fmi2Error, fmu.SerializeFMUstate(i.c, NULL, serialized, size));
    CHECK(fmu.SerializeFMUstate(i.c, state, serialized, size) == fmi2OK, "%s", i.text);
    REFUSED(fmi2Error, fmu.DeSerializeFMUstate(i.c, NULL, size, &other));
    REFUSED(fmi2Error, fmu.DeSerializeFMUstate(i.c, serialized, size, NULL));
    REFUSED(fmi2Error, fmu.DeSerializeFMUstate(i.c, serialized, 0, &other));
    REFUSED(fmi2Error, fmu.DeSerializeFMUstate(i.c, serialized, size - 1, &other));
    for (size_t k = 0; k < size; k += 97) {
        serialized[k] ^= 4;
        REFUSED(fmi2Error, fmu.DeSerializeFMUstate(i.c, serialized, size, &other));
        serialized[k] ^= 4;
    }
    CHECK(other == NULL, "a state of refused bytes");
    fmu.FreeFMUstate(i.c, &state);
    fmu.FreeInstance(i.c);
    CHECK(blocks == 0, "%ld blocks are not freed", blocks);
}

/* Steps that cannot be, between steps that can: these stay what they are without the others. */
static void steps(enum set which)
{
    const double h[] = {-1e-3, -1e-300, NAN, INFINITY, -INFINITY, 1e13, 1e300, 11.0};
    const double time[] = {-1.0, 0.5, 1e13, 1e300, NAN, INFINITY, -INFINITY};
    const double stroke[] = {0.4, -0.4, NAN, 1e300}, velocity[] = {19.0, NAN, INFINITY, 1e300};
    struct instance i, undisturbed;
    struct picture before, after;
    opened_in(&i, which, STEPPING);
    opened_in(&undisturbed, which, STEPPING);
    for (long k = 0; k < 3000; k++) {
        const double t = (double)k * STEP;
        double moved[2];
        motion(k, moved);
        if (k % 10 == 0) {
            before = taken(&i);
            REFUSED(fmi2Error, fmu.DoStep(i.c, t, h[k / 10 % 8], fmi2True));
            REFUSED(fmi2Error, fmu.DoStep(i.c, time[k / 10 % 7], STEP, fmi2True));
        }
        if (k % 10 == 5) {
            /* Inputs that are refused at once, or by the step; the time of the step may differ by rounding. */
            if (fmu.SetReal(i.c, &MOTION[0], 1, &stroke[k / 10 % 4]) != fmi2OK)
                CHECK(k / 10 % 4 > 1, "%s", i.text);
            if (fmu.SetReal(i.c, &MOTION[1], 1, &velocity[k / 10 % 4]) != fmi2OK)
                CHECK(k / 10 % 4 > 0, "%s", i.text);
            before = taken(&i);
            if (k / 10 % 4 < 2)
                REFUSED(fmi2Error, fmu.DoStep(i.c, t + 1e-10, STEP, fmi2True));
        }
        step(&i, k);
        step(&undisturbed, k);
        CHECK(sound(&i), "step %ld", k);
        before = taken(&i), after = taken(&undisturbed);
        CHECK(same(&before, &after), "step %ld differs after refused ones", k);
        if (k % 10 == 7) {
            /* Importers' rounding leaves steps of 1e-16 s. */
            const double h_small[] = {0.0, 1e-16, 1e-300, 5e-324};
            const fmi2Status status = fmu.DoStep(i.c, t + STEP, h_small[k / 10 % 4], fmi2True);
            CHECK(status == fmu.DoStep(undisturbed.c, t + STEP, h_small[k / 10 % 4], fmi2True), "%s", i.text);
            CHECK(status <= fmi2Warning && sound(&i), "step %ld: %s", k, i.text);
        }
    }
    fmu.FreeInstance(i.c);
    fmu.FreeInstance(undisturbed.c);
}

#endif

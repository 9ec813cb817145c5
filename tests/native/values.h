/* Numbers that no importer should set, for every input and parameter, and instances that must not come to be. */
#ifndef VALUES_H
#define VALUES_H

#include "abuse.h"

/* Steps after a value was taken; each is right, or refused with nothing changed. */
static void stepped(struct instance *i, const struct variable *v, double value)
{
    struct picture before, after;
    double moved[2] = {0.0, 15.0};
    int started;
    if (v->causality != INPUT)
        CHECK(fmu.SetReal(i->c, MOTION, 2, moved) == fmi2OK, "%s", i->text);
    started = fmu.ExitInitializationMode(i->c) == fmi2OK;
    CHECK(started || i->messages > 0, "%s = %g: refused without a message", v->name, value);
    CHECK(!started || sound(i), "%s = %g at the start", v->name, value);
    for (long k = 0; started && k < 12; k++) {
        fmi2Status status;
        motion(k * 40, moved);
        CHECK(fmu.SetReal(i->c, MOTION, 2, moved) == fmi2OK, "%s", i->text);
        before = taken(i);
        i->messages = 0;
        status = fmu.DoStep(i->c, before.time, 40 * STEP, fmi2True);
        if (status <= fmi2Warning) {
            CHECK(sound(i), "%s = %g: step %ld", v->name, value, k);
            continue;
        }
        after = taken(i);
        CHECK(status == fmi2Error && i->messages == 1, "%s = %g: %d", v->name, value, status);
        CHECK(same(&before, &after), "%s = %g: changed by a refused step", v->name, value);
    }
}

/* A number for one variable before the first step, and for what may change in between after it. */
static void number(enum set which, fmi2ValueReference vr, double value)
{
    const struct variable *v = &VARIABLE[vr];
    const int right = value >= v->min && value <= v->max && value - value == 0.0;
    struct instance i;
    struct picture before, after;
    fmi2Status status;
    for (int mode = INITIALIZING; mode <= (v->causality == FIXED ? INITIALIZING : STEPPING); mode++) {
        opened_in(&i, which, mode);
        before = taken(&i);
        status = set(&i, vr, value);
        CHECK(status == (right ? fmi2OK : fmi2Error), "%s = %g in mode %d: %d", v->name, value, mode, status);
        CHECK(i.messages == !right, "%s = %g: %s", v->name, value, i.text);
        after = taken(&i);
        CHECK(right || same(&before, &after), "%s = %g: changed though refused", v->name, value);
        if (right && mode == INITIALIZING)
            stepped(&i, v, value);
        if (right && mode == STEPPING) {
            before = taken(&i);
            status = fmu.DoStep(i.c, 0.0, 1e-3, fmi2True);
            after = taken(&i);
            CHECK(status <= fmi2Warning ? sound(&i) : i.messages > 0 && same(&before, &after), "%s = %g", v->name, value);
        }
        fmu.FreeInstance(i.c);
    }
}

static void numbers(enum set which)
{
    for (fmi2ValueReference vr = 0; vr < VARIABLES; vr++) {
        const struct variable *v = &VARIABLE[vr];
        const double value[] = {NAN, INFINITY, -INFINITY, 1e300, -1e300, 1.7e308, 5e-324, -5e-324, 1e-310, 1e-300, 1e-30,
                                -0.0, 0.0, v->min, v->max, nextafter(v->min, -INFINITY), nextafter(v->max, INFINITY),
                                nextafter(v->min, INFINITY), 0.5 * v->max};
        const int whole_value[] = {INT_MIN, -1, 0, 1, 2, 3, INT_MAX};
        if (v->causality == OUTPUT)
            continue;
        for (size_t k = 0; v->kind == REAL && k < sizeof value / sizeof *value; k++)
            number(which, vr, value[k]);
        for (size_t k = 0; v->kind == INTEGER && k < sizeof whole_value / sizeof *whole_value; k++)
            number(which, vr, whole_value[k]);
    }
    CHECK(blocks == 0, "%ld blocks are not freed", blocks);
}

/* A step that overflows leaves no trace in the k_degr of the rest after it. */
static void overflow(void)
{
    const double moved[] = {0.0, -18.0}, rest[] = {0.0, 0.0};
    struct instance i[2];
    double found[2][32];
    for (int k = 0; k < 2; k++) {
        open_instance(&i[k]);
        set_up(&i[k], DEGRADED, 0.5);
        CHECK(set(&i[k], reference("smooth_transition.build_up"), 0.003) == fmi2OK, "%s", i[k].text);
        CHECK(set(&i[k], reference("fv.F_co[20]"), 1.7e308) == fmi2OK, "%s", i[k].text);
        begin_steps(&i[k]);
        if (k == 0) {
            CHECK(fmu.SetReal(i[k].c, MOTION, 2, moved) == fmi2OK, "%s", i[k].text);
            CHECK(fmu.DoStep(i[k].c, 0.0, 1e-3, fmi2True) == fmi2Error && i[k].messages == 1, "%s", i[k].text);
        }
        CHECK(fmu.SetReal(i[k].c, MOTION, 2, rest) == fmi2OK, "%s", i[k].text);
        CHECK(fmu.DoStep(i[k].c, 0.0, 1e-3, fmi2True) == fmi2OK && get_outputs(&i[k], found[k]) == fmi2OK, "%s", i[k].text);
        fmu.FreeInstance(i[k].c);
    }
    CHECK(memcmp(found[0], found[1], outputs * sizeof(double)) == 0, "goes on in another way after a refused step");
}

/* A step in which no time passes leaves the force, which the oil and the rubber remember: rates over it would be infinite. */
static void no_time(void)
{
    const double h[] = {5e-324, 1e-300, 1e-170, 1e-16, 1e-9}, moved[] = {0.05, 0.0};
    for (size_t k = 0; k < sizeof h / sizeof *h; k++) {
        struct instance i;
        double found[2][32];
        open_instance(&i);
        set_up(&i, EXTENDED, 0.56);
        CHECK(set(&i, reference("seal_leak.leak_film"), 1e-200) == fmi2OK, "%s", i.text);
        CHECK(set(&i, reference("seal_leak.leak_power"), 2.0) == fmi2OK, "%s", i.text);
        CHECK(set(&i, reference("mount_compliance.tau_mount"), 0.0) == fmi2OK, "%s", i.text);
        CHECK(fmu.SetReal(i.c, MOTION, 2, moved) == fmi2OK, "%s", i.text);
        begin_steps(&i);
        CHECK(fmu.DoStep(i.c, 0.0, 1e-3, fmi2True) <= fmi2Warning && get_outputs(&i, found[0]) == fmi2OK, "%s", i.text);
        for (int n = 0; n < 100; n++)
            CHECK(fmu.DoStep(i.c, 1e-3, h[k], fmi2True) <= fmi2Warning && sound(&i), "%g s: %s", h[k], i.text);
        CHECK(get_outputs(&i, found[1]) == fmi2OK, "%s", i.text);
        CHECK(fabs(found[0][0] - found[1][0]) <= 1e-6 * (1.0 + fabs(found[0][0])), "%g N, %g N", found[0][0], found[1][0]);
        fmu.FreeInstance(i.c);
    }
}

/* The derivative of an input is that of the coming step only. */
static void derivative(void)
{
    const double rate = 30.0, none = 0.0;
    struct instance i[2];
    double found[2][32];
    for (int k = 0; k < 2; k++) {
        started(&i[k], DEGRADED, 0.56);
        CHECK(fmu.SetRealInputDerivatives(i[k].c, &MOTION[1], 1, orders, &rate) == fmi2OK, "%s", i[k].text);
        step(&i[k], 0);
        if (k == 1)
            CHECK(fmu.SetRealInputDerivatives(i[k].c, &MOTION[1], 1, orders, &none) == fmi2OK, "%s", i[k].text);
        step(&i[k], 1);
        CHECK(get_outputs(&i[k], found[k]) == fmi2OK, "%s", i[k].text);
        fmu.FreeInstance(i[k].c);
    }
    CHECK(memcmp(found[0], found[1], outputs * sizeof(double)) == 0, "a derivative acts twice");
}

/* A refused step uses it up too: importers set inputs anew then, and it was not meant for those. */
static void derivative_of_a_refused_step(void)
{
    const double rate = 30.0;
    struct instance i[2];
    double found[2][32];
    for (int k = 0; k < 2; k++) {
        started(&i[k], DEGRADED, 0.56);
        step(&i[k], 0);
        if (k == 1) {
            CHECK(fmu.SetRealInputDerivatives(i[k].c, &MOTION[1], 1, orders, &rate) == fmi2OK, "%s", i[k].text);
            CHECK(fmu.DoStep(i[k].c, STEP, NAN, fmi2True) == fmi2Error, "a step of NaN");
        }
        step(&i[k], 1);
        CHECK(get_outputs(&i[k], found[k]) == fmi2OK, "%s", i[k].text);
        fmu.FreeInstance(i[k].c);
    }
    CHECK(memcmp(found[0], found[1], outputs * sizeof(double)) == 0, "the derivative of a refused step acts later");
}

static void instances(void)
{
    struct instance i, other;
    fmi2CallbackFunctions *f = &i.functions;
    fmi2FMUstate state = NULL;
    fmi2Component c;
    open_instance(&i);
    fmu.FreeInstance(i.c);
#define NONE(...) \
    i.messages = 0; \
    CHECK(fmu.Instantiate(__VA_ARGS__) == NULL && i.messages == 1 && blocks == 0, "%d messages", i.messages)
    NONE("x", fmi2CoSimulation, "{another}", NULL, f, 0, 1);
    NONE("x", fmi2CoSimulation, "%s%n#r0#", NULL, f, 0, 1);
    NONE("x", fmi2CoSimulation, NULL, NULL, f, 0, 1);
    NONE(NULL, fmi2CoSimulation, VALUES.guid, NULL, f, 0, 1);
    NONE("", fmi2CoSimulation, VALUES.guid, NULL, f, 0, 1);
    NONE("x", fmi2ModelExchange, VALUES.guid, NULL, f, 0, 1);
    room = 0;
    NONE("x", fmi2CoSimulation, VALUES.guid, NULL, f, 0, 1);
    room = 1;
    NONE("x", fmi2CoSimulation, VALUES.guid, NULL, f, 0, 1);
    room = -1;
    CHECK(fmu.Instantiate("x", fmi2CoSimulation, VALUES.guid, NULL, NULL, 0, 1) == NULL, "no callback functions");

    /* No memory for a state: the instance goes on. */
    started(&i, DEGRADED, 0.56);
    room = 0;
    CHECK(fmu.GetFMUstate(i.c, &state) == fmi2Error && state == NULL && i.messages == 1, "%s", i.text);
    CHECK(fmu.DeSerializeFMUstate(i.c, serialized, sizeof serialized, &state) == fmi2Error && state == NULL, "%s", i.text);
    room = -1;
    step(&i, 0);
    fmu.FreeInstance(i.c);

    /* Callback functions may be missing: memory comes from the C library then, and nothing is said. */
    f->allocateMemory = NULL;
    for (int k = 0; k < 3; k++) {
        f->freeMemory = k ? NULL : release;
        f->allocateMemory = k == 1 ? allocate : NULL;
        f->logger = k == 2 ? NULL : log_message;
        other = i;
        c = other.c = fmu.Instantiate("y", fmi2CoSimulation, VALUES.guid, "file:///nowhere", f, fmi2True, fmi2True);
        CHECK(c != NULL && blocks == 0, "%ld blocks", blocks);
        begin_steps(&other);
        step(&other, 0);
        CHECK(fmu.GetFMUstate(c, &state) == fmi2OK && fmu.SetFMUstate(c, state) == fmi2OK, "%s", i.text);
        CHECK(fmu.FreeFMUstate(c, &state) == fmi2OK && fmu.DoStep(c, NAN, 1.0, fmi2True) == fmi2Error, "%s", i.text);
        fmu.FreeInstance(c);
    }
    CHECK(blocks == 0, "%ld blocks are not freed", blocks);
}

static void abuse(void)
{
    CHECK(strcmp(fmu.GetVersion(), "2.0") == 0 && strcmp(fmu.GetTypesPlatform(), "default") == 0, "another version");
    orders_of_calls();
    arguments(INITIALIZING);
    arguments(STEPPING);
    instances();
    overflow();
    no_time();
    derivative();
    derivative_of_a_refused_step();
    for (int which = INTACT; which <= EXTENDED; which++) {
        steps(which);
        numbers(which);
    }
}

#endif

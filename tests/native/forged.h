/* Serialized states with the right sum and wrong content: each is refused with a message, and changes nothing. */
#ifndef FORGED_H
#define FORGED_H

#include "abuse.h"

#define FIELD(name) (HEADER + offsetof(struct memory, name))

static fmi2Byte original[16384], wrong_bytes[16384];
static size_t state_size;

/* The state of an instance in a mode, as bytes. */
static void serialized_in(struct instance *i, enum set which, int mode)
{
    fmi2FMUstate state = NULL;
    opened_in(i, which, mode);
    if (mode == STEPPING) {
        for (long k = 0; k < 200; k++)
            step(i, k);
    }
    CHECK(fmu.GetFMUstate(i->c, &state) == fmi2OK, "%s", i->text);
    CHECK(fmu.SerializedFMUstateSize(i->c, state, &state_size) == fmi2OK && state_size <= sizeof original, "%zu", state_size);
    CHECK(state_size == HEADER + sizeof(struct memory), "%zu bytes", state_size);
    CHECK(fmu.SerializeFMUstate(i->c, state, original, state_size) == fmi2OK, "%s", i->text);
    CHECK(fmu.FreeFMUstate(i->c, &state) == fmi2OK, "%s", i->text);
}

/* Bytes that are refused with a message that has the words `words`. */
static void refused_bytes(struct instance *i, const char *what, const char *words)
{
    const int messages = i->messages;
    const struct picture before = taken(i);
    struct picture after;
    fmi2FMUstate state = NULL;
    CHECK(fmu.DeSerializeFMUstate(i->c, wrong_bytes, state_size, &state) == fmi2Error && state == NULL, "%s: accepted", what);
    CHECK(i->messages == messages + 1 && strstr(i->text, words), "%s: %s", what, i->text);
    after = taken(i);
    CHECK(same(&before, &after), "%s: changed", what);
}

static void with_bytes(struct instance *i, const char *what, size_t at, const void *value, size_t size)
{
    memcpy(wrong_bytes, original, state_size);
    memcpy(wrong_bytes + at, value, size);
    sign(wrong_bytes, state_size);
    refused_bytes(i, what, "damaged");
}

static void with_whole(struct instance *i, const char *what, size_t at, int32_t value)
{
    with_bytes(i, what, at, &value, sizeof value);
}

static void with_number(struct instance *i, const char *what, size_t at, double value)
{
    with_bytes(i, what, at, &value, sizeof value);
}

static void fields_of(enum set which, int mode)
{
    const double odd[] = {NAN, INFINITY, -INFINITY};
    const size_t outwards = offsetof(struct memory, wanted) - offsetof(struct memory, in_force);
    struct instance i;
    serialized_in(&i, which, mode);
    for (int k = 0; k < 4; k++) {
        const int32_t wrong[] = {-1, 4, INT_MAX, INT_MIN};
        with_whole(&i, "mode", FIELD(mode), wrong[k]);
        with_whole(&i, "timed", FIELD(timed), wrong[k]);
        with_whole(&i, "changed", FIELD(changed), wrong[k]);
        with_whole(&i, "stale", FIELD(stale), wrong[k]);
        with_whole(&i, "warned", FIELD(warned), wrong[k]);
        with_whole(&i, "long_step", FIELD(long_step), wrong[k]);
    }
    for (int k = 0; k < 3; k++) {
        with_number(&i, "time", FIELD(time), odd[k]);
        with_number(&i, "rate", FIELD(rate), odd[k]);
        with_number(&i, "stroke", FIELD(now.stroke), odd[k]);
        with_number(&i, "velocity", FIELD(now.velocity), odd[k]);
        if (k != 1) /* without a stop time it is infinite */
            with_number(&i, "stop", FIELD(stop), odd[k]);
        for (size_t n = 0; n < sizeof(struct kernel_State) / sizeof(double); n++)
            with_number(&i, "state", FIELD(now.s) + n * sizeof(double), odd[k]);
        for (size_t n = 0; n < sizeof(struct kernel_Flow) / sizeof(double); n++)
            with_number(&i, "flow", FIELD(now.f) + n * sizeof(double), odd[k]);
        for (size_t n = 0; n < sizeof(struct kernel_Agreement) / sizeof(double); n++)
            with_number(&i, "agreement", FIELD(now.a) + n * sizeof(double), odd[k]);
    }
    for (fmi2ValueReference vr = 0; vr < VARIABLES; vr++) {
        const struct variable *v = &VARIABLE[vr];
        const size_t at = HEADER + v->offset;
        const int64_t whole = 2;
        if (v->causality == INPUT || v->causality == OUTPUT)
            continue;
        if (v->kind == INTEGER) {
            with_bytes(&i, v->name, at, &whole, sizeof whole);
            with_bytes(&i, v->name, at - outwards, &whole, sizeof whole);
            continue;
        }
        with_number(&i, v->name, at, NAN);
        with_number(&i, v->name, at - outwards, NAN);
        with_number(&i, v->name, at, nextafter(v->min, -INFINITY));
        with_number(&i, v->name, at - outwards, v->max < INFINITY ? nextafter(v->max, INFINITY) : INFINITY);
    }
    if (mode >= STEPPING) {
        with_whole(&i, "stale between steps", FIELD(stale), 1);
        with_number(&i, "a place beyond the play", FIELD(now.a.at_apart), 0.003);
        with_number(&i, "a way below zero", FIELD(now.a.way_led), -1e-9);
        with_number(&i, "a velocity beyond any", FIELD(now.a.velocity), 1e300);
        with_number(&i, "a phase below zero", FIELD(now.s.V1_oil), -1e-6);
        with_number(&i, "a stroke beyond the tube", FIELD(now.s.z), 0.4);
        with_number(&i, "oil that does not fit", FIELD(in_force.p.V_oil), 4e-3);
    }
    fmu.FreeInstance(i.c);
}

/* What is derived is not taken from the bytes: with wrong numbers there the state is the same. */
static void derived_anew(void)
{
    const double half = 1e3;
    struct instance i;
    struct picture before, after;
    fmi2FMUstate state = NULL;
    serialized_in(&i, DEGRADED, STEPPING);
    before = taken(&i);
    memcpy(wrong_bytes, original, state_size);
    memcpy(wrong_bytes + FIELD(now.limit), &half, sizeof half);
    memcpy(wrong_bytes + FIELD(now.d.half_length), &half, sizeof half);
    memcpy(wrong_bytes + FIELD(now.out.force), &half, sizeof half);
    sign(wrong_bytes, state_size);
    CHECK(fmu.DeSerializeFMUstate(i.c, wrong_bytes, state_size, &state) == fmi2OK, "%s", i.text);
    CHECK(fmu.SetFMUstate(i.c, state) == fmi2OK && fmu.FreeFMUstate(i.c, &state) == fmi2OK, "%s", i.text);
    after = taken(&i);
    CHECK(same(&before, &after), "outputs of a state with forged outputs");
    fmu.FreeInstance(i.c);
}

static void headers_of(void)
{
    struct instance i;
    serialized_in(&i, DEGRADED, STEPPING);
    memcpy(wrong_bytes, original, state_size);
    wrong_bytes[0] ^= 1;
    refused_bytes(&i, "GUID", "another FMU");
    memcpy(wrong_bytes, original, state_size);
    wrong_bytes[SIZE_AT] ^= 1;
    refused_bytes(&i, "size", "another FMU");
    memcpy(wrong_bytes, original, state_size);
    wrong_bytes[SUM_AT] ^= 1;
    refused_bytes(&i, "sum", "damaged");
    fmu.FreeInstance(i.c);
}

static void forged_states(void)
{
    for (int which = INTACT; which <= EXTENDED; which++) {
        for (int mode = INSTANTIATED; mode <= TERMINATED; mode++)
            fields_of(which, mode);
    }
    derived_anew();
    headers_of();
    CHECK(blocks == 0, "%ld blocks are not freed", blocks);
}

#endif

/* FMU state: a copy of the memory of an instance; serialized with a header that says whether it fits. */
#ifndef STATE_H
#define STATE_H

struct header {
    char equations[16];
    char guid[64]; /* of the FMU: its start values, its table of variables and the layout of its memory */
    uint64_t size, sum;
};

/* FNV-1a, to refuse bytes that were cut or changed. */
static uint64_t sum_of(const void *data, size_t size)
{
    const unsigned char *bytes = data;
    uint64_t sum = 14695981039346656037u;
    for (size_t i = 0; i < size; i++)
        sum = (sum ^ bytes[i]) * 1099511628211u;
    return sum;
}

static struct header header_of(const void *memory)
{
    const struct header head = {MODEL_EQUATIONS, MODEL_GUID, sizeof(struct memory), sum_of(memory, sizeof(struct memory))};
    return head;
}

static int is_flag(int32_t value)
{
    return value == 0 || value == 1;
}

/* Whether inputs and parameters are within their bounds, those in force and those that wait. */
static int bounded(struct memory *m)
{
    const size_t waits = offsetof(struct memory, wanted), size = sizeof(struct parameters);
    for (fmi2ValueReference i = 0; i < VARIABLES; i++) {
        struct variable v = VARIABLE[i];
        if (v.causality == OUTPUT)
            continue;
        for (int in_force = 0; in_force < 2; in_force++) {
            const double value = v.kind == INTEGER ? (double)*integer_of(m, &v) : *real_of(m, &v);
            if (!within(value, v.min, v.max))
                return 0;
            if (v.offset >= waits && v.offset < waits + size)
                v.offset += offsetof(struct memory, in_force) - waits;
        }
    }
    return 1;
}

/* Whether bytes with the right sum are the memory of an instance; anybody can write a sum. What follows from the rest is
   computed anew. `quiet` is an instance that says nothing. */
static int credible(struct unit *quiet, struct memory *m)
{
    bind(&m->in_force);
    bind(&m->wanted);
    if (m->mode < INSTANTIATED || m->mode > TERMINATED || !is_flag(m->timed) || !is_flag(m->changed) || !is_flag(m->stale)
        || !is_flag(m->warned) || !is_flag(m->long_step) || (m->stale && m->mode >= STEPPING))
        return 0;
    if (!within(m->rate, -STEEPEST, STEEPEST) || !within(m->time, -2.0 * LONGEST, 2.0 * LONGEST)
        || !(m->stop == INFINITY || within(m->stop, -LONGEST, LONGEST)))
        return 0;
    if (!bounded(m) || !all_numbers(m))
        return 0;
    if (m->stale) /* the start is computed before anything is asked for */
        return 1;
    if (!admissible(quiet, &m->in_force))
        return 0;
    derive(m);
    publish(m);
    return possible(m);
}

static void restore(struct unit *u, const struct memory *from)
{
    u->m = *from;
    bind(&u->m.in_force);
    bind(&u->m.wanted);
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    struct unit *u = c;
    if (!allowed(u, "fmi2GetFMUstate", EVERYWHERE) || !given(u, "fmi2GetFMUstate", state, state, 1))
        return fmi2Error;
    if (*state == NULL)
        *state = reserve(u, sizeof u->m);
    if (*state == NULL)
        return refuse(u, "fmi2GetFMUstate: no memory");
    memcpy(*state, &u->m, sizeof u->m);
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state)
{
    struct unit *u = c;
    if (!allowed(u, "fmi2SetFMUstate", EVERYWHERE) || !given(u, "fmi2SetFMUstate", state, state, 1))
        return fmi2Error;
    restore(u, state);
    return fmi2OK;
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    struct unit *u = c;
    if (!allowed(u, "fmi2FreeFMUstate", EVERYWHERE))
        return fmi2Error;
    if (state != NULL && *state != NULL) {
        drop(u, *state);
        *state = NULL;
    }
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    struct unit *u = c;
    if (!allowed(u, "fmi2SerializedFMUstateSize", EVERYWHERE) || !given(u, "fmi2SerializedFMUstateSize", state, size, 1))
        return fmi2Error;
    *size = sizeof(struct header) + sizeof(struct memory);
    return fmi2OK;
}

/* Equal states have equal bytes: without addresses, and without what an effect changes in `d` for the length of a step. */
static struct memory portable(const void *state)
{
    struct memory m;
    memcpy(&m, state, sizeof m);
    if (!m.stale) {
        bind(&m.in_force);
        derive(&m);
    }
    unbind(&m.in_force);
    unbind(&m.wanted);
    return m;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    struct unit *u = c;
    struct header head;
    struct memory m;
    if (!allowed(u, "fmi2SerializeFMUstate", EVERYWHERE) || !given(u, "fmi2SerializeFMUstate", state, bytes, 1))
        return fmi2Error;
    if (size < sizeof head + sizeof m)
        return refuse(u, "fmi2SerializeFMUstate: %u bytes, %u are needed", (unsigned)size, (unsigned)(sizeof head + sizeof m));
    m = portable(state);
    head = header_of(&m);
    memcpy(bytes, &head, sizeof head);
    memcpy(bytes + sizeof head, &m, sizeof m);
    return fmi2OK;
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state)
{
    static const char NAME[] = "fmi2DeSerializeFMUstate";
    struct unit *u = c, quiet;
    struct header head, right;
    struct memory m;
    if (!allowed(u, NAME, EVERYWHERE) || !given(u, NAME, bytes, state, 1))
        return fmi2Error;
    if (size < sizeof head + sizeof m)
        return refuse(u, SAY_NO_STATE, NAME);
    memcpy(&head, bytes, sizeof head);
    memcpy(&m, bytes + sizeof head, sizeof m);
    right = header_of(&m);
    if (memcmp(head.equations, right.equations, sizeof head.equations) || memcmp(head.guid, right.guid, sizeof head.guid)
        || head.size != right.size)
        return refuse(u, SAY_OTHER_STATE, NAME);
    memset(&quiet, 0, sizeof quiet);
    if (head.sum != right.sum || !credible(&quiet, &m))
        return refuse(u, SAY_DAMAGED_STATE, NAME);
    if (*state == NULL)
        *state = reserve(u, sizeof m);
    if (*state == NULL)
        return refuse(u, "%s: no memory", NAME);
    memcpy(*state, &m, sizeof m);
    return fmi2OK;
}

#endif

/* FMU state: a copy of the memory of an instance; serialized with a header that says whether it fits. */
#ifndef STATE_H
#define STATE_H

#include "instance.h"

struct header {
    char guid[64]; /* of the FMU: it follows from equations, table of variables and start values */
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
    struct header head;
    memcpy(head.guid, VALUES.guid, sizeof head.guid);
    head.size = sizeof(struct memory);
    head.sum = sum_of(memory, sizeof(struct memory));
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
    for (unsigned i = 0; i < VARIABLES; i++) {
        struct variable v = VARIABLE[i];
        if (v.causality == OUTPUT || v.causality == INDEPENDENT)
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
}

static enum status get_state(struct unit *u, const char *function, void **state)
{
    if (!allowed(u, function, EVERYWHERE) || !given(u, function, state, state, 1))
        return REFUSED;
    if (*state == NULL)
        *state = u->allocate(1, sizeof u->m);
    if (*state == NULL)
        return refuse(u, "%s: no memory", function);
    memcpy(*state, &u->m, sizeof u->m);
    return DONE;
}

static enum status set_state(struct unit *u, const char *function, const void *state)
{
    if (!allowed(u, function, EVERYWHERE) || !given(u, function, state, state, 1))
        return REFUSED;
    restore(u, state);
    return DONE;
}

static enum status free_state(struct unit *u, const char *function, void **state)
{
    if (!allowed(u, function, EVERYWHERE))
        return REFUSED;
    if (state != NULL && *state != NULL) {
        u->release(*state);
        *state = NULL;
    }
    return DONE;
}

static enum status serialized_size(struct unit *u, const char *function, const void *state, size_t *size)
{
    if (!allowed(u, function, EVERYWHERE) || !given(u, function, state, size, 1))
        return REFUSED;
    *size = sizeof(struct header) + sizeof(struct memory);
    return DONE;
}

/* Equal states have equal bytes: without what an effect changes in `d` for the length of a step. */
static struct memory portable(const void *state)
{
    struct memory m;
    memcpy(&m, state, sizeof m);
    if (!m.stale)
        derive(&m);
    return m;
}

static enum status serialize(struct unit *u, const char *function, const void *state, void *bytes, size_t size)
{
    struct header head;
    struct memory m;
    if (!allowed(u, function, EVERYWHERE) || !given(u, function, state, bytes, 1))
        return REFUSED;
    if (size < sizeof head + sizeof m)
        return refuse(u, "%s: %u bytes, %u are needed", function, (unsigned)size, (unsigned)(sizeof head + sizeof m));
    m = portable(state);
    head = header_of(&m);
    memcpy(bytes, &head, sizeof head);
    memcpy((char *)bytes + sizeof head, &m, sizeof m);
    return DONE;
}

static enum status deserialize(struct unit *u, const char *function, const void *bytes, size_t size, void **state)
{
    struct unit quiet;
    struct header head, right;
    struct memory m;
    if (!allowed(u, function, EVERYWHERE) || !given(u, function, bytes, state, 1))
        return REFUSED;
    if (size < sizeof head + sizeof m)
        return refuse(u, SAY_NO_STATE, function);
    memcpy(&head, bytes, sizeof head);
    memcpy(&m, (const char *)bytes + sizeof head, sizeof m);
    right = header_of(&m);
    if (memcmp(head.guid, right.guid, sizeof head.guid) || head.size != right.size)
        return refuse(u, SAY_OTHER_STATE, function);
    memset(&quiet, 0, sizeof quiet);
    if (head.sum != right.sum || !credible(&quiet, &m))
        return refuse(u, SAY_DAMAGED_STATE, function);
    if (*state == NULL)
        *state = u->allocate(1, sizeof m);
    if (*state == NULL)
        return refuse(u, "%s: no memory", function);
    memcpy(*state, &m, sizeof m);
    return DONE;
}

#endif

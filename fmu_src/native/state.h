/* FMU state: a copy of the memory of an instance; serialized with a header that tells whether it fits. */
#ifndef STATE_H
#define STATE_H

struct header {
    char magic[16]; /* of the equations and the layout */
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

static void restore(struct unit *u, const struct memory *from)
{
    u->m = *from;
    bind(&u->m.damper);
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

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    struct unit *u = c;
    struct header head = {MODEL_EQUATIONS, sizeof(struct memory), 0};
    struct memory m;
    if (!allowed(u, "fmi2SerializeFMUstate", EVERYWHERE) || !given(u, "fmi2SerializeFMUstate", state, bytes, 1))
        return fmi2Error;
    if (size < sizeof head + sizeof m)
        return refuse(u, "fmi2SerializeFMUstate: %u bytes, %u are needed", (unsigned)size, (unsigned)(sizeof head + sizeof m));
    memcpy(&m, state, sizeof m);
    /* Addresses mean nothing elsewhere; equal states have equal bytes. */
    m.damper.p.v_re.data = m.damper.p.F_re.data = m.damper.p.v_co.data = m.damper.p.F_co.data = NULL;
    m.wanted.p.v_re.data = m.wanted.p.F_re.data = m.wanted.p.v_co.data = m.wanted.p.F_co.data = NULL;
    head.sum = sum_of(&m, sizeof m);
    memcpy(bytes, &head, sizeof head);
    memcpy(bytes + sizeof head, &m, sizeof m);
    return fmi2OK;
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state)
{
    struct unit *u = c;
    const struct header right = {MODEL_EQUATIONS, sizeof(struct memory), 0};
    struct header head;
    if (!allowed(u, "fmi2DeSerializeFMUstate", EVERYWHERE) || !given(u, "fmi2DeSerializeFMUstate", bytes, state, 1))
        return fmi2Error;
    if (size < sizeof head + sizeof(struct memory))
        return refuse(u, "fmi2DeSerializeFMUstate: %u bytes are too few", (unsigned)size);
    memcpy(&head, bytes, sizeof head);
    if (memcmp(head.magic, right.magic, sizeof head.magic) || head.size != right.size
        || head.sum != sum_of(bytes + sizeof head, sizeof(struct memory)))
        return refuse(u, "fmi2DeSerializeFMUstate: the bytes are not a state of this model");
    if (*state == NULL)
        *state = reserve(u, sizeof(struct memory));
    if (*state == NULL)
        return refuse(u, "fmi2DeSerializeFMUstate: no memory");
    memcpy(*state, bytes + sizeof head, sizeof(struct memory));
    return fmi2OK;
}

#endif

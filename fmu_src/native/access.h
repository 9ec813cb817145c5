/* Reading and setting of values and derivatives. */
#ifndef ACCESS_H
#define ACCESS_H

/* The variable of a value reference if it has the kind; else NULL and a message. */
static const struct variable *find(struct unit *u, const char *function, fmi2ValueReference vr, enum kind kind)
{
    if (vr < VARIABLES && VARIABLE[vr].kind == kind)
        return &VARIABLE[vr];
    refuse(u, SAY_NO_VARIABLE, function, kind == REAL ? "Real" : "Integer", vr <= INT_MAX ? (int)vr : -1);
    return NULL;
}

/* Whether a variable may be set now to a value. */
static int settable(struct unit *u, const struct variable *v, double value)
{
    if (v->causality == OUTPUT) {
        refuse(u, SAY_NOT_SETTABLE, v->name);
        return 0;
    }
    if (v->causality == FIXED && u->m.mode == STEPPING) {
        refuse(u, SAY_FIXED, v->name);
        return 0;
    }
    return in_bounds(u, v, value);
}

/* Before the first step outputs follow from the start values. */
static int current(struct unit *u)
{
    return u->m.mode >= STEPPING || begin(u);
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Real value[])
{
    struct unit *u = c;
    if (!allowed(u, "fmi2GetReal", EVERYWHERE) || !given(u, "fmi2GetReal", vr, value, n))
        return fmi2Error;
    for (size_t i = 0; i < n; i++) {
        const struct variable *v = find(u, "fmi2GetReal", vr[i], REAL);
        if (v == NULL || (v->causality == OUTPUT && !current(u)))
            return fmi2Error;
        value[i] = *real_of(&u->m, v);
    }
    return fmi2OK;
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Integer value[])
{
    struct unit *u = c;
    if (!allowed(u, "fmi2GetInteger", EVERYWHERE) || !given(u, "fmi2GetInteger", vr, value, n))
        return fmi2Error;
    for (size_t i = 0; i < n; i++) {
        const struct variable *v = find(u, "fmi2GetInteger", vr[i], INTEGER);
        if (v == NULL)
            return fmi2Error;
        value[i] = (fmi2Integer)*integer_of(&u->m, v);
    }
    return fmi2OK;
}

static void touched(struct memory *m, const struct variable *v)
{
    m->stale = m->mode < STEPPING;
    m->changed |= v->causality != INPUT;
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Real value[])
{
    struct unit *u = c;
    if (!allowed(u, "fmi2SetReal", EVERYWHERE & ~(1 << TERMINATED)) || !given(u, "fmi2SetReal", vr, value, n))
        return fmi2Error;
    for (size_t i = 0; i < n; i++) {
        const struct variable *v = find(u, "fmi2SetReal", vr[i], REAL);
        if (v == NULL || !settable(u, v, value[i]))
            return fmi2Error;
    }
    for (size_t i = 0; i < n; i++) {
        *real_of(&u->m, &VARIABLE[vr[i]]) = value[i];
        touched(&u->m, &VARIABLE[vr[i]]);
    }
    return fmi2OK;
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Integer value[])
{
    struct unit *u = c;
    if (!allowed(u, "fmi2SetInteger", EVERYWHERE & ~(1 << TERMINATED)) || !given(u, "fmi2SetInteger", vr, value, n))
        return fmi2Error;
    for (size_t i = 0; i < n; i++) {
        const struct variable *v = find(u, "fmi2SetInteger", vr[i], INTEGER);
        if (v == NULL || !settable(u, v, value[i]))
            return fmi2Error;
    }
    for (size_t i = 0; i < n; i++) {
        *integer_of(&u->m, &VARIABLE[vr[i]]) = value[i];
        touched(&u->m, &VARIABLE[vr[i]]);
    }
    return fmi2OK;
}

/* There are no Boolean and no String variables. */
static fmi2Status none(fmi2Component c, const char *function, const char *kind, size_t n)
{
    struct unit *u = c;
    if (!allowed(u, function, EVERYWHERE))
        return fmi2Error;
    return n == 0 ? fmi2OK : refuse(u, "%s: there is no %s variable", function, kind);
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Boolean value[])
{
    (void)vr, (void)value;
    return none(c, "fmi2GetBoolean", "Boolean", n);
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2String value[])
{
    (void)vr, (void)value;
    return none(c, "fmi2GetString", "String", n);
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Boolean value[])
{
    (void)vr, (void)value;
    return none(c, "fmi2SetBoolean", "Boolean", n);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2String value[])
{
    (void)vr, (void)value;
    return none(c, "fmi2SetString", "String", n);
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Integer order[],
                                       const fmi2Real value[])
{
    struct unit *u = c;
    if (!allowed(u, "fmi2SetRealInputDerivatives", EVERYWHERE & ~(1 << TERMINATED))
        || !given(u, "fmi2SetRealInputDerivatives", vr, value, n) || !given(u, "fmi2SetRealInputDerivatives", order, order, n))
        return fmi2Error;
    for (size_t i = 0; i < n; i++) {
        const struct variable *v = find(u, "fmi2SetRealInputDerivatives", vr[i], REAL);
        if (v == NULL)
            return fmi2Error;
        if (v->causality != INPUT || order[i] != 1)
            return refuse(u, "%s: derivatives are those of inputs and of order 1, not %d", v->name, (int)order[i]);
        if (!inside(u, "derivative of an input", value[i], -STEEPEST, STEEPEST, " per second"))
            return fmi2Error;
    }
    for (size_t i = 0; i < n; i++) {
        if (VARIABLE[vr[i]].offset == DERIVED_INPUT)
            u->m.rate = value[i];
    }
    return fmi2OK;
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Integer order[],
                                        fmi2Real value[])
{
    (void)vr, (void)order, (void)value;
    return none(c, "fmi2GetRealOutputDerivatives", "output derivative of a", n);
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[], size_t n,
                                        const fmi2ValueReference known[], size_t k, const fmi2Real dknown[], fmi2Real dunknown[])
{
    (void)unknown, (void)known, (void)k, (void)dknown, (void)dunknown;
    return none(c, "fmi2GetDirectionalDerivative", "directional derivative of a", n);
}

#endif

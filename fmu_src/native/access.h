/* Reading and setting of values by their references. */
#ifndef ACCESS_H
#define ACCESS_H

#include "instance.h"

/* How many values a value reference has: those of this row and the next. */
static size_t length_of(const struct variable *v)
{
    return ARRAYS ? v->length : 1;
}

/* The variable of a value reference if it has the kind; else NULL and a message. */
static const struct variable *find(struct unit *u, const char *function, unsigned vr, enum kind kind)
{
    if (vr < VARIABLES && VARIABLE[vr].kind == kind && length_of(&VARIABLE[vr]) > 0)
        return &VARIABLE[vr];
    refuse(u, SAY_NO_VARIABLE, function, KIND[kind], vr <= INT_MAX ? (int)vr : -1);
    return NULL;
}

/* Whether references have as many values as the importer says, which it need not say truly; else a message is logged. */
static int counted(struct unit *u, const char *function, const unsigned vr[], size_t n, enum kind kind, size_t values)
{
    size_t wanted = 0;
    for (size_t i = 0; i < n; i++) {
        const struct variable *v = find(u, function, vr[i], kind);
        if (v == NULL)
            return 0;
        wanted += length_of(v);
    }
    if (wanted == values)
        return 1;
    refuse(u, "%s: %u values, the variables have %u", function, (unsigned)values, (unsigned)wanted);
    return 0;
}

/* Whether a variable may be set now to a value. */
static int settable(struct unit *u, const struct variable *v, double value)
{
    if (v->causality == OUTPUT || v->causality == INDEPENDENT) {
        refuse(u, v->causality == OUTPUT ? SAY_NOT_SETTABLE : "%s: cannot be set", v->name);
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

static enum status get_reals(struct unit *u, const char *function, const unsigned vr[], size_t n, double value[], size_t values)
{
    if (!allowed(u, function, EVERYWHERE) || !given(u, function, vr, value, n)
        || !counted(u, function, vr, n, REAL, values))
        return REFUSED;
    for (size_t i = 0; i < n; i++) {
        const struct variable *v = &VARIABLE[vr[i]];
        if (v->causality == OUTPUT && !current(u))
            return REFUSED;
        for (size_t k = 0; k < length_of(v); k++)
            *value++ = *real_of(&u->m, &v[k]);
    }
    return DONE;
}

static enum status get_integers(struct unit *u, const char *function, const unsigned vr[], size_t n, int value[], size_t values)
{
    if (!allowed(u, function, EVERYWHERE) || !given(u, function, vr, value, n)
        || !counted(u, function, vr, n, INTEGER, values))
        return REFUSED;
    for (size_t i = 0; i < n; i++) {
        const struct variable *v = &VARIABLE[vr[i]];
        for (size_t k = 0; k < length_of(v); k++)
            *value++ = (int)*integer_of(&u->m, &v[k]);
    }
    return DONE;
}

static void touched(struct memory *m, const struct variable *v)
{
    m->stale = m->mode < STEPPING;
    m->changed |= v->causality != INPUT;
}

/* All values are set or, if one of them is refused, none. */
static enum status set_reals(struct unit *u, const char *function, const unsigned vr[], size_t n, const double value[],
                             size_t values)
{
    const double *next = value;
    if (!allowed(u, function, BEFORE_THE_END) || !given(u, function, vr, value, n)
        || !counted(u, function, vr, n, REAL, values))
        return REFUSED;
    for (size_t i = 0; i < n; i++) {
        const struct variable *v = &VARIABLE[vr[i]];
        for (size_t k = 0; k < length_of(v); k++) {
            if (!settable(u, &v[k], *next++))
                return REFUSED;
        }
    }
    for (size_t i = 0; i < n; i++) {
        const struct variable *v = &VARIABLE[vr[i]];
        for (size_t k = 0; k < length_of(v); k++)
            *real_of(&u->m, &v[k]) = *value++;
        touched(&u->m, v);
    }
    return DONE;
}

static enum status set_integers(struct unit *u, const char *function, const unsigned vr[], size_t n, const int value[],
                                size_t values)
{
    const int *next = value;
    if (!allowed(u, function, BEFORE_THE_END) || !given(u, function, vr, value, n)
        || !counted(u, function, vr, n, INTEGER, values))
        return REFUSED;
    for (size_t i = 0; i < n; i++) {
        const struct variable *v = &VARIABLE[vr[i]];
        for (size_t k = 0; k < length_of(v); k++) {
            if (!settable(u, &v[k], *next++))
                return REFUSED;
        }
    }
    for (size_t i = 0; i < n; i++) {
        const struct variable *v = &VARIABLE[vr[i]];
        for (size_t k = 0; k < length_of(v); k++)
            *integer_of(&u->m, &v[k]) = *value++;
        touched(&u->m, v);
    }
    return DONE;
}

/* For what the unit has none of. */
static enum status none(struct unit *u, const char *function, const char *what, size_t n)
{
    if (!allowed(u, function, EVERYWHERE))
        return REFUSED;
    return n == 0 ? DONE : refuse(u, "%s: there is no %s", function, what);
}

#endif

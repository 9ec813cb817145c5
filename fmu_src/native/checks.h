/* The checks of the interpreter: bounds from variables.h, rules from kernel.h, texts from messages.h. */
#ifndef CHECKS_H
#define CHECKS_H

#include "unit.h"

static int within(double value, double low, double high)
{
    return value >= low && value <= high && value - value == 0.0; /* neither NaN nor infinite */
}

/* Whether a value is a number within its bounds; else a message is logged. `unit` begins with a space or is empty. */
static int inside(struct unit *u, const char *name, double value, double low, double high, const char *unit)
{
    if (within(value, low, high))
        return 1;
    /* Some C libraries print the sign of NaN. */
    refuse(u, SAY_OUTSIDE, name, value == value ? value : fabs(value), unit, low, high, unit);
    return 0;
}

/* The name without the index of an array, as in the table. */
static int in_bounds(struct unit *u, const struct variable *v, double value)
{
    char name[64];
    if (within(value, v->min, v->max))
        return 1;
    snprintf(name, sizeof name, "%.*s", (int)strcspn(v->name, "["), v->name);
    return inside(u, name, value, v->min, v->max, v->unit);
}

/* Whether all is a number: what the outputs do not show spoils later steps. */
static int numbers(const void *record, size_t size)
{
    const double *value = record;
    int wrong = 0;
    for (size_t i = 0; i < size / sizeof *value; i++)
        wrong |= value[i] - value[i] != 0.0; /* without a branch: compilers do several at once */
    return !wrong;
}

/* Of each model, in step.h. */
static int admissible(struct unit *u, struct parameters *of);
static void derive(struct memory *m);

/* Take over the parameters that were set; nothing changes where they are not admissible. */
static int take_over(struct unit *u)
{
    struct memory *m = &u->m;
    if (!admissible(u, &m->wanted)) {
        if (m->mode == STEPPING) {
            copy_parameters(&m->wanted, &m->in_force);
            m->changed = 0;
        }
        return 0;
    }
    copy_parameters(&m->in_force, &m->wanted);
    derive(m);
    m->changed = 0;
    return 1;
}

#endif

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

/* Whether a parameter set is admissible; bounds were checked when it was set. */
static int admissible(struct unit *u, struct damper *damper)
{
    struct kernel_Violation broken;
    struct kernel_Derived d;
    int64_t rule;
    memset(&broken, 0, sizeof broken);
    memset(&d, 0, sizeof d);
    rule = kernel_curve_rule(&damper->p, 0, &broken);
    if (rule == 0)
        rule = kernel_fit_rule(&damper->p, &d, 0, &broken);
    if (rule == 0)
        return 1;
    if (broken.point > 0)
        refuse(u, RULE[rule], (int)broken.point, broken.value, broken.limit);
    else
        refuse(u, RULE[rule], broken.value, broken.limit);
    return 0;
}

#endif

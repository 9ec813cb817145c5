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

/* The name of the variable with this value. */
static const char *name_of(const struct unit *u, const double *value)
{
    const size_t offset = (size_t)((const char *)value - (const char *)&u->m);
    for (unsigned i = 0; i < VARIABLES; i++) {
        if (VARIABLE[i].offset == offset)
            return VARIABLE[i].name;
    }
    return "";
}

/* Follow two inputs, a way and its velocity, from a communication point on which `h` [s] are to follow; a warning, once, where
   they do not belong together. */
static enum status follow(struct unit *u, struct kernel_Agreement *a, const double *way, const double *velocity, double h)
{
    const char *led;
    if (u->m.warned || !kernel_parted(a, *way, *velocity, h))
        return DONE;
    u->m.warned = 1;
    led = name_of(u, velocity);
    return warn(u, SAY_PARTED, u->m.time, name_of(u, way), a->way_stroke + fabs(a->at_stroke), led, a->way_led + fabs(a->at_led),
                a->way_apart + fabs(a->at_apart), led);
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
            m->wanted = m->in_force;
            m->changed = 0;
        }
        return 0;
    }
    m->in_force = m->wanted;
    derive(m);
    m->changed = 0;
    return 1;
}

#endif

/* Start and step of the damper around the translated equations. */
#ifndef DAMPER_H
#define DAMPER_H

#include "checks.h"

/* Whether all is a number: what the outputs do not show spoils later steps. */
static int numbers(const void *record, size_t size)
{
    const double *value = record;
    int wrong = 0;
    for (size_t i = 0; i < size / sizeof *value; i++)
        wrong |= value[i] - value[i] != 0.0; /* without a branch: compilers do several at once */
    return !wrong;
}

static int computed(struct memory *m)
{
    const double force = kernel_total_force(&m->s);
    return force - force == 0.0 && numbers(&m->s, sizeof m->s);
}

/* What follows from the parameters in force. */
static void derive(struct memory *m)
{
    kernel_set_up(&m->damper.p, &m->d);
    m->limit = kernel_stroke_limit(&m->d);
}

/* Take over the parameters that were set; nothing changes where they are not admissible. */
static int take_over(struct unit *u)
{
    struct memory *m = &u->m;
    if (!admissible(u, &m->wanted)) {
        if (m->mode == STEPPING) {
            copy_damper(&m->wanted, &m->damper);
            m->changed = 0;
        }
        return 0;
    }
    copy_damper(&m->damper, &m->wanted);
    derive(m);
    m->changed = 0;
    return 1;
}

/* The damper at rest at the stroke that is set. */
static int begin(struct unit *u)
{
    struct memory *m = &u->m;
    if (!m->stale)
        return 1;
    if (!take_over(u) || !inside(u, "stroke", m->stroke, -m->limit, m->limit, " m"))
        return 0;
    memset(&m->s, 0, sizeof m->s);
    memset(&m->f, 0, sizeof m->f);
    m->f.k_degr = m->f.k_mean = 1.0;
    kernel_start(&m->damper.p, &m->d, &m->s, m->stroke);
    kernel_advance(&m->damper.p, &m->d, &m->s, &m->f, m->stroke, m->velocity, m->velocity, 0.0);
    if (!computed(m)) {
        refuse(u, SAY_NO_START);
        return 0;
    }
    kernel_publish(&m->d, &m->s, &m->out);
    m->stale = 0;
    return 1;
}

/* One step of `h` >= 0 [s] while the velocity changes by `rate` [m/s2]; a message, and the state as before, where it is
   refused. */
static fmi2Status move(struct unit *u, double h, double rate)
{
    struct memory *m = &u->m;
    const double z = m->stroke, v = m->velocity, after = v + rate * h;
    const double end = z + (v + 0.5 * rate * h) * h;
    double jump;
    struct kernel_State before;
    struct kernel_Flow flow;
    fmi2Status status = fmi2OK;

    if (m->changed && !take_over(u))
        return fmi2Error;
    if (!inside(u, "stroke", z, -m->limit, m->limit, " m")
        || !inside(u, "stroke at the end of the step", end, -m->limit, m->limit, " m")
        || !inside(u, "velocity at the end of the step", after, LOWEST_VELOCITY, HIGHEST_VELOCITY, " m/s"))
        return fmi2Error;
    before = m->s;
    flow = m->f;
    jump = kernel_stroke_jump(&m->d, &m->s, z);
    if (!kernel_advance(&m->damper.p, &m->d, &m->s, &m->f, end, v, after, h) || !computed(m)) {
        m->s = before;
        m->f = flow;
        return refuse(u, SAY_NO_STEP, m->time);
    }
    kernel_publish(&m->d, &m->s, &m->out);
    if (!m->warned && jump != 0.0) {
        m->warned = 1;
        status = warn(u, SAY_STROKE_JUMP, m->time, z, z - jump);
    }
    return status;
}

#endif

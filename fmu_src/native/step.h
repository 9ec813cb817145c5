/* Start and step of the damper around the translated equations. */
#ifndef STEP_H
#define STEP_H

#include "checks.h"

/* Whether a parameter set is admissible; bounds were checked when it was set. */
static int admissible(struct unit *u, struct parameters *of)
{
    struct kernel_Violation broken;
    struct kernel_Derived d;
    int64_t rule;
    memset(&broken, 0, sizeof broken);
    memset(&d, 0, sizeof d);
    rule = kernel_curve_rule(&of->p, 0, &broken);
    if (rule == 0)
        rule = kernel_fit_rule(&of->p, &d, 0, &broken);
    if (rule == 0)
        return 1;
    if (broken.point > 0)
        refuse(u, RULE[rule], (int)broken.point, broken.value, broken.limit);
    else
        refuse(u, RULE[rule], broken.value, broken.limit);
    return 0;
}

static int computed(struct memory *m)
{
    const double force = kernel_total_force(&m->now.s);
    return force - force == 0.0 && numbers(&m->now.s, sizeof m->now.s);
}

/* What follows from the parameters in force. */
static void derive(struct memory *m)
{
    kernel_set_up(&m->in_force.p, &m->now.d);
    m->now.limit = kernel_stroke_limit(&m->now.d);
}

static void publish(struct memory *m)
{
    kernel_publish(&m->now.d, &m->now.s, &m->now.out);
}

/* For states from elsewhere: whether all that is remembered are numbers, and those of a damper. */
static int all_numbers(const struct memory *m)
{
    return numbers(&m->now.s, sizeof m->now.s) && numbers(&m->now.f, sizeof m->now.f)
        && numbers(&m->now.out, sizeof m->now.out) && numbers(&m->now.a, sizeof m->now.a);
}

static int possible(struct memory *m)
{
    return kernel_possible(&m->now.d, &m->now.s) == 1 && kernel_followed(&m->now.a) == 1
        && (m->now.beyond_law == 0 || m->now.beyond_law == 1);
}

/* The damper at rest at the stroke that is set. */
static int begin(struct unit *u)
{
    struct memory *m = &u->m;
    if (!m->stale)
        return 1;
    if (!take_over(u) || !inside(u, "stroke", m->now.stroke, -m->now.limit, m->now.limit, " m"))
        return 0;
    memset(&m->now.s, 0, sizeof m->now.s);
    memset(&m->now.f, 0, sizeof m->now.f);
    memset(&m->now.a, 0, sizeof m->now.a);
    m->now.a.stroke = m->now.stroke;
    m->now.a.velocity = m->now.velocity;
    m->now.f.k_degr = m->now.f.k_mean = 1.0;
    kernel_start(&m->in_force.p, &m->now.d, &m->now.s, m->now.stroke);
    m->now.s.temperature = m->now.temperature;
    kernel_advance(&m->in_force.p, &m->now.d, &m->now.s, &m->now.f, m->now.stroke, m->now.velocity, m->now.velocity, 0.0);
    if (!computed(m)) {
        refuse(u, SAY_NO_START);
        return 0;
    }
    publish(m);
    m->stale = 0;
    return 1;
}

/* Say, once in a run, what a step of `h` [s] does to a wheel in the loop; whether there is one nobody knows here. */
static enum status timely(struct unit *u, double h)
{
    if (u->m.long_step || h <= SAFE_STEP + kernel_time_slack(u->m.time, h))
        return DONE;
    u->m.long_step = 1;
    return warn(u, SAY_LONG_STEP, u->m.time, h, SAFE_STEP);
}

/* Say, once in a run, that the law of the damper does not hold at its temperature. */
static enum status lawful(struct unit *u)
{
    const struct kernel_Parameters *p = &u->m.in_force.p;
    if (u->m.now.beyond_law || kernel_within_law(p, u->m.now.s.T))
        return DONE;
    u->m.now.beyond_law = 1;
    return warn(u, "time %g s: " SAY_BEYOND_LAW, u->m.time, u->m.now.s.T, p->T_cold, p->T_hot);
}

/* One step of `h` >= 0 [s] while the velocity changes by `rate` [m/s2]; a message, and the state as before, where it is
   refused. */
static enum status move(struct unit *u, double h, double rate)
{
    struct memory *m = &u->m;
    const double z = m->now.stroke, v = m->now.velocity, after = v + rate * h;
    const double end = z + (v + 0.5 * rate * h) * h;
    struct kernel_State before;
    struct kernel_Flow flow;
    int warned;

    if (m->changed && !take_over(u))
        return REFUSED;
    if (!inside(u, "stroke", z, -m->now.limit, m->now.limit, " m")
        || !inside(u, "stroke at the end of the step", end, -m->now.limit, m->now.limit, " m")
        || !inside(u, "velocity at the end of the step", after, LOWEST_VELOCITY, HIGHEST_VELOCITY, " m/s"))
        return REFUSED;
    before = m->now.s;
    flow = m->now.f;
    m->now.s.temperature = m->now.temperature;
    if (!kernel_advance(&m->in_force.p, &m->now.d, &m->now.s, &m->now.f, end, v, after, h) || !computed(m)) {
        m->now.s = before;
        m->now.f = flow;
        return refuse(u, SAY_NO_STEP, m->time);
    }
    publish(m);
    warned = timely(u, h) != DONE;
    warned |= lawful(u) != DONE;
    warned |= follow(u, &m->now.a, &m->now.stroke, &m->now.velocity, h) != DONE;
    return warned ? WARNED : DONE;
}

#endif

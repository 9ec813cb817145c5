/* Start and step of the damper around the translated equations. */
#ifndef DAMPER_H
#define DAMPER_H

#include "checks.h"

#define STROKE_JUMP 0.02 /* [m] from here on a stroke that the velocity did not lead to is worth a warning */
#define SPEED_LIMIT 20.0 /* [m/s] */

static void publish(struct memory *m)
{
    const struct kernel_State *s = &m->s;
    struct outputs *o = &m->out;
    const double gas = m->d.V_reserve - s->V3_oil - s->V3_foam;
    o->force = s->F_fluid + s->F_friction + s->F_gas;
    o->k_degr = s->k_degr;
    o->V1_oil = s->V1_oil;
    o->V1_gas = s->V1_gas;
    o->V1_foam = s->V1_foam;
    o->V2_oil = s->V2_oil;
    o->V2_gas = s->V2_gas;
    o->V2_foam = s->V2_foam;
    o->V3_oil = s->V3_oil;
    o->V3_gas = gas > 0.0 ? gas : 0.0;
    o->V3_foam = s->V3_foam;
    o->force_fluid = s->F_fluid;
    o->force_friction = s->F_friction;
    o->force_gas = s->F_gas;
    o->work = s->work;
}

/* Whether all is a number: what the outputs do not show spoils later steps. */
static int computed(const struct kernel_State *s)
{
    const double *value = (const double *)s, force = s->F_fluid + s->F_friction + s->F_gas;
    int wrong = force - force != 0.0;
    for (size_t i = 0; i < sizeof *s / sizeof *value; i++)
        wrong |= value[i] - value[i] != 0.0;
    return !wrong;
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
    kernel_set_up(&m->damper.p, &m->d);
    m->limit = m->d.half_length - CLEARANCE;
    m->changed = 0;
    return 1;
}

/* The damper at rest at the stroke that is set. */
static int begin(struct unit *u)
{
    struct memory *m = &u->m;
    if (!m->stale)
        return 1;
    if (!take_over(u) || !inside(u, "stroke", m->stroke, -m->limit, m->limit, "m"))
        return 0;
    memset(&m->s, 0, sizeof m->s);
    memset(&m->f, 0, sizeof m->f);
    m->f.k_degr = m->f.k_mean = 1.0;
    kernel_start(&m->damper.p, &m->d, &m->s, m->stroke);
    kernel_advance(&m->damper.p, &m->d, &m->s, &m->f, m->stroke, m->velocity, m->velocity, 0.0);
    if (!computed(&m->s)) {
        refuse(u, "the start could not be computed; please report this parameter set");
        return 0;
    }
    publish(m);
    m->stale = 0;
    return 1;
}

/* One step of `h` >= 0 [s]; a message, and the state as before, where it is refused. */
static fmi2Status move(struct unit *u, double h)
{
    struct memory *m = &u->m;
    const double z = m->stroke, v = m->velocity, after = v + m->velocity_rate * h;
    const double end = z + (v + 0.5 * m->velocity_rate * h) * h;
    const double jump = z - (m->d.extended > 0 ? m->s.z_rod : m->s.z);
    struct kernel_State before;
    struct kernel_Flow flow;
    fmi2Status status = fmi2OK;

    if (m->changed && !take_over(u))
        return fmi2Error;
    if (!inside(u, "stroke", z, -m->limit, m->limit, "m")
        || !inside(u, "stroke at the end of the step", end, -m->limit, m->limit, "m")
        || !inside(u, "velocity at the end of the step", after, -SPEED_LIMIT, SPEED_LIMIT, "m/s"))
        return fmi2Error;
    before = m->s;
    flow = m->f;
    if (!kernel_advance(&m->damper.p, &m->d, &m->s, &m->f, end, v, after, h) || !computed(&m->s)) {
        m->s = before;
        m->f = flow;
        return refuse(u, "time %g s: the step could not be computed; please report this parameter set", m->time);
    }
    publish(m);
    m->velocity_rate = 0.0;
    if (!m->warned && (jump > STROKE_JUMP || jump < -STROKE_JUMP)) {
        m->warned = 1;
        status = warn(u, "time %g s: stroke = %g m, but the velocity led to %g m; check its sign and unit", m->time, z, z - jump);
    }
    return status;
}

#endif

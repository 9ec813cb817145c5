/* Start and step of the car around the translated equations. */
#ifndef STEP_H
#define STEP_H

#include "checks.h"

#define LONGEST_SPAN 1.0 /* [s] of a communication step: each has many parts */

/* The bounds of each parameter are all that there is to check. */
static int admissible(struct unit *u, struct parameters *of)
{
    (void)u, (void)of;
    return 1;
}

/* What follows from the parameters in force. */
static void derive(struct memory *m)
{
    struct model *now = &m->now;
    now->c = m->in_force.body;
    now->k[0] = now->k[1] = m->in_force.front;
    now->k[2] = now->k[3] = m->in_force.rear;
    kernel_set_up_car(&now->c, &now->k[0], &now->k[1], &now->k[2], &now->k[3]);
}

static void publish(struct memory *m)
{
    struct model *now = &m->now;
    kernel_publish_body(&now->b, &now->out, &now->t);
    for (int i = 0; i < 4; i++)
        kernel_publish_wheel(&now->b, &now->k[i], &now->w[i], &now->wheel[i], &now->t);
}

static int all_numbers(const struct memory *m)
{
    return numbers(&m->now, sizeof m->now);
}

static int possible(struct memory *m)
{
    const struct kernel_Course *t = &m->now.t;
    for (int i = 0; i < 4; i++) {
        if (!kernel_followed(&m->now.a[i]))
            return 0;
    }
    return within(t->span, 0.0, LONGEST_SPAN) && within(t->earlier, 0.0, LONGEST_SPAN) && within(t->part, 0.0, LONGEST_SPAN);
}

/* The car rolling straight ahead on a flat road. */
static int begin(struct unit *u)
{
    struct memory *m = &u->m;
    struct model *now = &m->now;
    if (!m->stale)
        return 1;
    if (!take_over(u))
        return 0;
    memset(&now->b, 0, sizeof now->b);
    memset(now->w, 0, sizeof now->w);
    memset(&now->t, 0, sizeof now->t);
    memset(now->a, 0, sizeof now->a);
    for (int i = 0; i < 4; i++) {
        now->a[i].stroke = now->given[i].road;
        now->a[i].velocity = now->given[i].road_rate;
    }
    kernel_start_car(&now->b, &now->k[0], &now->k[1], &now->k[2], &now->k[3], &now->w[0], &now->w[1], &now->w[2], &now->w[3],
                     &now->given[0], &now->given[1], &now->given[2], &now->given[3], m->in_force.speed);
    publish(m);
    if (!all_numbers(m)) {
        refuse(u, SAY_NO_START);
        return 0;
    }
    m->stale = 0;
    return 1;
}

/* One step of `h` >= 0 [s]; a message, and the state as before, where it is refused. */
static enum status move(struct unit *u, double h, double rate)
{
    struct memory *m = &u->m;
    struct model *now = &m->now;
    const struct model before = *now;
    enum status status = DONE;
    (void)rate;
    if (!inside(u, "communication step", h, 0.0, LONGEST_SPAN, " s"))
        return REFUSED;
    kernel_communication_step(&now->c, &now->b, &now->k[0], &now->k[1], &now->k[2], &now->k[3], &now->w[0], &now->w[1],
                              &now->w[2], &now->w[3], &m->in_force.brakes, &now->driver, &now->given[0], &now->given[1],
                              &now->given[2], &now->given[3], &now->t, h);
    publish(m);
    if (!all_numbers(m)) {
        *now = before;
        return refuse(u, SAY_NO_STEP, m->time);
    }
    for (int i = 0; i < 4 && status == DONE; i++)
        status = follow(u, &now->a[i], &now->given[i].road, &now->given[i].road_rate, h);
    return status;
}

#endif

/* Written by twintube/fmu/translate.py from the equations 63a925a97edbb19a, body 62708c1d6cefbd07; do not edit. */
#ifndef QUARTER_H
#define QUARTER_H

#include "subset.h"

struct quarter_Car {
    double m_body;
    double m_wheel;
    double c_body;
    double d_links;
    double c_tyre;
    double d_tyre;
    double ratio;
    double travel;
    double c_stop;
    double d_stop;
    double F_rest;
};

struct quarter_Motion {
    double z_body;
    double z_wheel;
    double v_body;
    double v_wheel;
    double dv_body;
    double dv_wheel;
};

/* Wheel load at rest [N]. */
static double quarter_static_load(struct quarter_Car* car)
{
    return (car->m_body + car->m_wheel) * 9.80665;
}

/* Force [N] of a rubber stop under `compression` [m] at `velocity` [m/s], never a pull (Hunt and Crossley). */
static double quarter_stop_force(struct quarter_Car* car, double compression, double velocity)
{
    if (compression <= 0.0)
    {
        return 0.0;
    }
    return double_max(2, 0.0, car->c_stop * compression * compression * compression * (1.0 + car->d_stop * velocity));
}

/* One leapfrog step of `dt` [s] with the damper `force` [N] at its start; returns the wheel load [N].
   `push` [N] presses the body down: the load that braking moves to the front axle. The wheel load is never negative: the
   tyre does not pull on the road (height `road` [m], rate `road_velocity` [m/s]). */
static double quarter_leapfrog_step(struct quarter_Car* car, struct quarter_Motion* m, double road, double road_velocity, double force, double push, double dt)
{
    double v_body;
    double v_wheel;
    double weight;
    double stroke;
    double velocity;
    double pull;
    double load;
    /* Velocities at the start of the step: half a step after the stored ones. */
    v_body = m->v_body + 0.5 * m->dv_body;
    v_wheel = m->v_wheel + 0.5 * m->dv_wheel;
    weight = (car->m_body + car->m_wheel) * 9.80665;
    load = weight + car->c_tyre * (road - m->z_wheel);
    if (load > 0.0)
    {
        load += car->d_tyre * (road_velocity - v_wheel);
    }
    load = double_max(2, load, 0.0);
    stroke = m->z_body - m->z_wheel;
    velocity = v_body - v_wheel;
    pull = car->c_body * stroke + car->d_links * velocity + car->ratio * (force - car->F_rest);
    pull += quarter_stop_force(car, stroke - car->travel, velocity) - quarter_stop_force(car, (-stroke) - car->travel, -velocity);
    m->dv_body = (-dt) * (pull + push) / car->m_body;
    m->dv_wheel = dt * (pull + load - weight) / car->m_wheel;
    m->v_body += m->dv_body;
    m->v_wheel += m->dv_wheel;
    m->z_body += dt * m->v_body;
    m->z_wheel += dt * m->v_wheel;
    return load;
}

/* Stroke of the damper [m], positive in rebound. */
static double quarter_damper_stroke(struct quarter_Car* car, struct quarter_Motion* m)
{
    return car->ratio * (m->z_body - m->z_wheel);
}

/* Mean velocity of the damper [m/s] over the last `leapfrog_step`. */
static double quarter_damper_velocity(struct quarter_Car* car, struct quarter_Motion* m)
{
    return car->ratio * (m->v_body - m->v_wheel);
}

#endif

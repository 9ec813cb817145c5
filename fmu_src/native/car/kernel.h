/* Written by twintube/fmu/translate.py from the equations a02d1d4106f45640, body 7160496b0dffe64d; do not edit. */
#ifndef KERNEL_H
#define KERNEL_H

#include "subset.h"

struct kernel_Body {
    double wheelbase;
    double height;
    double I_roll;
    double I_pitch;
    double I_yaw;
    double drag;
    double mass;
    double x_front;
    double x_rear;
};

struct kernel_BodyMotion {
    double q_x;
    double q_y;
    double q_z;
    double q_yaw;
    double q_pitch;
    double q_roll;
    double m_all;
    double m_x;
    double m_h;
    double m_g;
    double m_xg;
    double i_pitch;
    double i_yaw;
    double i_roll;
    double power;
    double x;
    double y;
    double yaw;
    double z;
    double pitch;
    double roll;
    double v_x;
    double v_y;
    double v_z;
    double w_yaw;
    double w_pitch;
    double w_roll;
    double dv_x;
    double dv_y;
    double dv_z;
    double dw_yaw;
    double dw_pitch;
    double dw_roll;
    double a_x;
    double a_y;
    double way;
    double seen;
    double behind;
    double work;
};

struct kernel_Wheel {
    double radius;
    double I_spin;
    double F_nominal;
    double rise_x;
    double rise_x2;
    double s_most_x;
    double s_most_x2;
    double most_x;
    double most_x2;
    double s_slide_x;
    double s_slide_x2;
    double slide_x;
    double slide_x2;
    double rise_y;
    double rise_y2;
    double s_most_y;
    double s_most_y2;
    double most_y;
    double most_y2;
    double s_slide_y;
    double s_slide_y2;
    double slide_y;
    double slide_y2;
    double c_x;
    double d_x;
    double c_y;
    double d_y;
    double track;
    double h_roll;
    double support;
    double c_bar;
    double steer_compliance;
    double steers;
    double drive;
    double brake;
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
    double x;
    double y;
    double weight;
};

struct kernel_WheelMotion {
    double z;
    double v;
    double dv;
    double spin;
    double d_spin;
    double e_x;
    double e_y;
    double de_x;
    double de_y;
    double grip;
    double load;
    double F_x;
    double F_y;
    double lifted;
    double aside;
    double slip_x;
    double slip_y;
    double stroke;
    double velocity;
    double road;
    double road_rate;
    double damper;
    double before;
    double acting;
    double pressure;
    double waiting;
    double controlled;
    double order;
    double rim;
};

struct kernel_Brakes {
    double slip_release;
    double slip_build;
    double fall;
    double rise;
    double drift;
    double catch;
    double regain;
    double build;
    double release;
    double apply;
    double cycle;
    double slowest;
};

struct kernel_DriverInputs {
    double steer;
    double brake_pressure;
    double speed;
    double torque;
    double grip;
};

struct kernel_WheelInputs {
    double force;
    double road;
    double road_rate;
};

struct kernel_BodyOutputs {
    double x;
    double y;
    double z;
    double yaw;
    double pitch;
    double roll;
    double v_x;
    double v_y;
    double v_z;
    double yaw_rate;
    double a_x;
    double a_y;
    double a_z;
};

struct kernel_WheelOutputs {
    double stroke;
    double velocity;
    double height;
    double load;
    double F_x;
    double F_y;
    double slip_x;
    double slip_y;
    double spin;
    double pressure;
};

struct kernel_Course {
    double span;
    double earlier;
    double part;
};

struct kernel_Agreement {
    double stroke;
    double velocity;
    double change;
    double step;
    double at_stroke;
    double at_led;
    double at_apart;
    double way_stroke;
    double way_led;
    double way_apart;
    double doubt;
};

/* Mass and places of the axles from the sprung masses of a front and a rear corner [kg]. */
static void kernel_balance_body(struct kernel_Body* c, double front, double rear)
{
    c->mass = 2.0 * front + 2.0 * rear;
    c->x_front = c->wheelbase * (2.0 * rear) / c->mass;
    c->x_rear = c->wheelbase * (2.0 * front) / c->mass;
}

/* Place and load at rest of a wheel at `x` [m]; `side` is 1 for a left wheel and -1 for a right one. */
static void kernel_place_wheel(struct kernel_Wheel* k, double x, double side)
{
    k->x = x;
    k->y = k->track / 2.0 * side;
    k->weight = (k->m_body + k->m_wheel) * 9.80665;
}

/* Fill in what follows from the values of the file. */
static void kernel_set_up_car(struct kernel_Body* c, struct kernel_Wheel* k1, struct kernel_Wheel* k2, struct kernel_Wheel* k3, struct kernel_Wheel* k4)
{
    kernel_balance_body(c, k1->m_body, k3->m_body);
    kernel_place_wheel(k1, c->x_front, 1.0);
    kernel_place_wheel(k2, c->x_front, -1.0);
    kernel_place_wheel(k3, -c->x_rear, 1.0);
    kernel_place_wheel(k4, -c->x_rear, -1.0);
}

/* A wheel that rolls freely at a `speed` [m/s] on a flat road; its brake may be applied. */
static void kernel_start_wheel(struct kernel_Wheel* k, struct kernel_WheelMotion* w, double speed)
{
    w->spin = speed / k->radius;
    w->rim = speed;
    w->order = 1.0;
    w->grip = 1.0;
}

/* Let the car roll straight ahead at a `speed` [m/s]; its records hold zeros. */
static void kernel_start_car(struct kernel_BodyMotion* b, struct kernel_Wheel* k1, struct kernel_Wheel* k2, struct kernel_Wheel* k3, struct kernel_Wheel* k4, struct kernel_WheelMotion* w1, struct kernel_WheelMotion* w2, struct kernel_WheelMotion* w3, struct kernel_WheelMotion* w4, struct kernel_WheelInputs* j1, struct kernel_WheelInputs* j2, struct kernel_WheelInputs* j3, struct kernel_WheelInputs* j4, double speed)
{
    b->v_x = speed;
    b->seen = speed;
    kernel_start_wheel(k1, w1, speed);
    kernel_start_wheel(k2, w2, speed);
    kernel_start_wheel(k3, w3, speed);
    kernel_start_wheel(k4, w4, speed);
    w1->damper = j1->force;
    w2->damper = j2->force;
    w3->damper = j3->force;
    w4->damper = j4->force;
}

/* The damper force of the last communication step. */
static void kernel_take_force(struct kernel_WheelMotion* w, struct kernel_WheelInputs* j)
{
    w->before = w->damper;
    w->damper = j->force;
}

/* `change_part` of a wheel. */
static void kernel_change_wheel(struct kernel_WheelMotion* w, double factor)
{
    w->v += 0.5 * (1.0 - factor) * w->dv;
    w->spin += 0.5 * (1.0 - factor) * w->d_spin;
    w->dv *= factor;
    w->d_spin *= factor;
}

/* Take the speeds to half of the coming part before now, `factor` times as long as the last part. */
static void kernel_change_part(struct kernel_BodyMotion* b, struct kernel_WheelMotion* w1, struct kernel_WheelMotion* w2, struct kernel_WheelMotion* w3, struct kernel_WheelMotion* w4, double factor)
{
    b->v_x += 0.5 * (1.0 - factor) * b->dv_x;
    b->v_y += 0.5 * (1.0 - factor) * b->dv_y;
    b->v_z += 0.5 * (1.0 - factor) * b->dv_z;
    b->w_yaw += 0.5 * (1.0 - factor) * b->dw_yaw;
    b->w_pitch += 0.5 * (1.0 - factor) * b->dw_pitch;
    b->w_roll += 0.5 * (1.0 - factor) * b->dw_roll;
    b->dv_x *= factor;
    b->dv_y *= factor;
    b->dv_z *= factor;
    b->dw_yaw *= factor;
    b->dw_pitch *= factor;
    b->dw_roll *= factor;
    kernel_change_wheel(w1, factor);
    kernel_change_wheel(w2, factor);
    kernel_change_wheel(w3, factor);
    kernel_change_wheel(w4, factor);
}

/* Road, its grip and damper force `at` [s] within a step; the force is carried on by `ahead` mean steps. */
static void kernel_meet_road(struct kernel_WheelMotion* w, struct kernel_WheelInputs* j, double grip, double ahead, double at)
{
    w->grip = grip;
    w->road = j->road + at * j->road_rate;
    w->road_rate = j->road_rate;
    w->acting = w->damper + ahead * (w->damper - w->before);
}

/* Carry the speed that the control takes for the car's over `dt` [s], by those of the rims [m/s].
   The second fastest counts, and only so fast: on an uneven road rims run ahead of the car again and again. */
static void kernel_seen_speed(struct kernel_Brakes* h, struct kernel_BodyMotion* b, double r1, double r2, double r3, double r4, double dt)
{
    double leading;
    double behind;
    double second;
    double foreseen;
    leading = double_min(2, double_max(2, r1, r2), double_max(2, r3, r4));
    behind = double_max(2, double_min(2, r1, r2), double_min(2, r3, r4));
    second = double_max(2, leading, behind);
    foreseen = b->seen + b->a_x * dt;
    b->seen = double_min(2, double_max(2, second, foreseen - h->drift * dt), foreseen + h->catch * dt);
}

/* What follows on an order, by the slip of a wheel and the acceleration of its rim [m/s2]. */
static double kernel_next_order(struct kernel_Brakes* h, double order, double slip, double rate)
{
    if (order == 2.0)
    {
        return (rate > h->rise ? 3.0 : 2.0);
    }
    if ((slip > h->slip_release) && (rate <= h->rise))
    {
        return 2.0;
    }
    if (order == 3.0)
    {
        return ((slip < h->slip_build) || (rate < h->rise) ? 1.0 : 3.0);
    }
    return (rate < -h->fall ? 0.0 : 1.0);
}

/* Carry the pressure of a wheel's brake over `dt` [s]; `wanted` [Pa] is the driver's, `seen` [m/s] the estimate. */
static void kernel_control_brake(struct kernel_Brakes* h, struct kernel_Wheel* k, struct kernel_WheelMotion* w, double seen, double wanted, double dt)
{
    double rim;
    double rate;
    double order;
    bool slow;
    double growth;
    w->waiting -= dt;
    if (w->waiting <= 0.0)
    {
        w->waiting += h->cycle;
        rim = k->radius * w->spin;
        rate = (rim - w->rim) / h->cycle;
        w->rim = rim;
        if ((seen < h->slowest) || (w->pressure <= 0.0))
        {
            w->order = 1.0;
        }
        else
        {
            order = kernel_next_order(h, w->order, 1.0 - rim / seen, rate);
            w->order = order;
        }
    }
    if (w->order == 2.0)
    {
        w->pressure = double_max(2, 0.0, w->pressure - h->release * dt);
    }
    else if (w->order == 1.0)
    {
        slow = (seen >= h->slowest) && (w->controlled > 0.0) && (w->pressure >= h->regain * w->controlled);
        growth = (slow ? h->build : h->apply);
        w->pressure = double_min(2, wanted, w->pressure + growth * dt);
    }
    w->pressure = double_min(2, w->pressure, wanted);
}

/* Of the body alone: air drag, the inertial forces that speeds make, its mass and inertias. */
static void kernel_begin_sums(struct kernel_Body* c, struct kernel_BodyMotion* b)
{
    double v_x;
    double v_y;
    double w_yaw;
    double drag;
    v_x = b->v_x + 0.5 * b->dv_x;
    v_y = b->v_y + 0.5 * b->dv_y;
    w_yaw = b->w_yaw + 0.5 * b->dw_yaw;
    drag = (-c->drag) * v_x * fabs(v_x);
    b->q_x = drag + c->mass * w_yaw * v_y;
    b->q_y = (-c->mass) * w_yaw * v_x;
    b->q_z = 0.0;
    b->q_yaw = 0.0;
    b->q_pitch = 0.0;
    b->q_roll = 0.0;
    b->m_all = c->mass;
    b->m_x = 0.0;
    b->m_h = 0.0;
    b->m_g = 0.0;
    b->m_xg = 0.0;
    b->i_pitch = c->I_pitch;
    b->i_yaw = c->I_yaw;
    b->i_roll = c->I_roll;
    b->power = drag * v_x;
}

/* Force [N] of a tyre deflected by `e` [m], whose contact slides at `slide` [m/s]; at rest the secant's times the slip.
   The force of the deflection, c e + d de/dt, is that of the slip with the deflection's own speed in it. */
static double kernel_deflect(double c, double d, double secant, double slide, double speed, double e)
{
    double rate;
    rate = (-(speed * c * e + secant * slide)) / (speed * d + secant);
    return c * e + d * rate;
}

/* A force [N] or rise at a `load` [nominal loads] from those at one and two nominal loads: a parabola through 0. */
static double kernel_over_load(double nominal, double double_0001, double load)
{
    return load * (2.0 * nominal - 0.5 * double_0001 - (nominal - 0.5 * double_0001) * load);
}

/* A slip at a `load` [nominal loads] from those at one and two nominal loads: a line. */
static double kernel_between_loads(double nominal, double double_0001, double load)
{
    return nominal + (double_0001 - nominal) * (load - 1.0);
}

/* Length of a vector; `math.hypot` rounds otherwise in Python than in C. */
static double kernel_combined(double along, double across)
{
    return sqrt(along * along + across * across);
}

/* Force over slip [N] at a `slip` >= 0: the secant of the curve through its rise, largest force and sliding force. */
static double kernel_force_over_slip(double slip, double rise, double s_most, double most, double s_slide, double slide)
{
    double bend;
    double share;
    double curvature;
    double change;
    double force;
    double end;
    rise = double_max(2, rise, 2.0 * most / s_most);
    if (slip > s_slide)
    {
        return slide / slip;
    }
    if (slip < s_most)
    {
        bend = rise * s_most / most - 2.0;
        share = slip / s_most;
        return rise / (1.0 + (share + bend) * share);
    }
    /* From the largest force on: a parabola, then another to the sliding force. */
    curvature = most / s_most * (most / s_most) / (rise * s_most);
    change = s_most + (most - slide) / (curvature * (s_slide - s_most));
    if (change <= s_slide)
    {
        if (slip <= change)
        {
            force = most - curvature * (slip - s_most) * (slip - s_most);
        }
        else
        {
            end = curvature * (change - s_most) / (s_slide - change);
            force = slide + end * (s_slide - slip) * (s_slide - slip);
        }
        return force / slip;
    }
    share = (slip - s_most) / (s_slide - s_most);
    return (most - (most - slide) * share * share * (3.0 - 2.0 * share)) / slip;
}

/* One step of `dt` [s] of the deflections; writes the forces `F_x`, `F_y` [N] and slips at the start of the step.
   `v_x`, `v_y` [m/s] are the speeds of the contact over the ground in the wheel's directions, rolling not counted; `w.load`
   is the vertical load [N] and `w.grip` the road's factor of all forces. */
static void kernel_roll_tyre(struct kernel_Wheel* k, struct kernel_WheelMotion* w, double v_x, double v_y, double dt)
{
    double rolling;
    double slide_x;
    double slide_y;
    double grip;
    double speed;
    double load;
    double secant_x;
    double secant_y;
    double rise_x;
    double rise_y;
    double most_x;
    double most_y;
    double s_x;
    double s_y;
    double unit_x;
    double unit_y;
    double n_x;
    double n_y;
    double slip;
    double along;
    double across;
    double rise;
    double s_most;
    double most;
    double s_slide;
    double slide;
    double secant;
    rolling = k->radius * (w->spin + 0.5 * w->d_spin);
    slide_x = v_x - rolling;
    slide_y = v_y;
    grip = w->grip;
    speed = double_max(2, fabs(rolling), 0.1);
    load = double_min(2, w->load / k->F_nominal, 3.5);
    secant_x = 0.0;
    secant_y = 0.0;
    w->slip_x = (-slide_x) / speed;
    w->slip_y = (-slide_y) / speed;
    if (load > 0.0)
    {
        rise_x = kernel_over_load(k->rise_x, k->rise_x2, load);
        rise_y = kernel_over_load(k->rise_y, k->rise_y2, load);
        most_x = kernel_over_load(k->most_x, k->most_x2, load);
        most_y = kernel_over_load(k->most_y, k->most_y2, load);
        s_x = kernel_between_loads(k->s_most_x, k->s_most_x2, load);
        s_y = kernel_between_loads(k->s_most_y, k->s_most_y2, load);
        /* Slips that make equal shares of the largest forces, in both directions. */
        unit_x = s_x / (s_x + s_y) + most_x / rise_x / (most_x / rise_x + most_y / rise_y);
        unit_y = s_y / (s_x + s_y) + most_y / rise_y / (most_x / rise_x + most_y / rise_y);
        n_x = w->slip_x / unit_x;
        n_y = w->slip_y / unit_y;
        slip = kernel_combined(n_x, n_y);
        along = sqrt(0.5);
        across = sqrt(0.5);
        if (slip > 1e-09)
        {
            along = n_x / slip;
            across = n_y / slip;
        }
        rise = kernel_combined(rise_x * unit_x * along, rise_y * unit_y * across);
        s_most = kernel_combined(s_x / unit_x * along, s_y / unit_y * across);
        most = kernel_combined(most_x * along, most_y * across);
        s_slide = kernel_combined(kernel_between_loads(k->s_slide_x, k->s_slide_x2, load) / unit_x * along, kernel_between_loads(k->s_slide_y, k->s_slide_y2, load) / unit_y * across);
        slide = kernel_combined(kernel_over_load(k->slide_x, k->slide_x2, load) * along, kernel_over_load(k->slide_y, k->slide_y2, load) * across);
        /* Grip scales forces and slips, not the rise. */
        secant = kernel_force_over_slip(slip, rise, grip * s_most, grip * most, grip * s_slide, grip * slide);
        secant_x = secant / unit_x;
        secant_y = secant / unit_y;
    }
    w->F_x = kernel_deflect(k->c_x, k->d_x, secant_x, slide_x, speed, w->e_x);
    w->F_y = kernel_deflect(k->c_y, k->d_y, secant_y, slide_y, speed, w->e_y);
    w->de_x = (w->F_x - k->c_x * w->e_x) / k->d_x;
    w->de_y = (w->F_y - k->c_y * w->e_y) / k->d_y;
    /* Implicit midpoint of a linear relaxation. */
    w->e_x += dt * w->de_x / (1.0 + 0.5 * dt * speed * k->c_x / (speed * k->d_x + secant_x));
    w->e_y += dt * w->de_y / (1.0 + 0.5 * dt * speed * k->c_y / (speed * k->d_y + secant_y));
}

/* Turn a wheel by its `drive` torque [N.m], tyre and brake; returns the torque of the brake, which can hold it. */
static double kernel_turn_wheel(struct kernel_Wheel* k, struct kernel_WheelMotion* w, double drive, double dt)
{
    double free;
    double most;
    double braked;
    free = w->spin + dt * (drive - w->F_x * k->radius) / k->I_spin;
    most = dt * k->brake * w->pressure / k->I_spin;
    braked = copysign(double_max(2, fabs(free) - most, 0.0), free);
    w->d_spin = braked - w->spin;
    w->spin = braked;
    return (braked - free) * k->I_spin / dt;
}

/* Force [N] of a rubber stop under `compression` [m] at `velocity` [m/s], never a pull (Hunt and Crossley). */
static double kernel_stop_force(struct kernel_Wheel* car, double compression, double velocity)
{
    if (compression <= 0.0)
    {
        return 0.0;
    }
    return double_max(2, 0.0, car->c_stop * compression * compression * compression * (1.0 + car->d_stop * velocity));
}

/* Forces of a wheel and its suspension, its tyre and spin carried over `dt` [s]; adds what it does to the body.
   `other` is the wheel at the axle's other end, `side` 1 for a left wheel and -1 for a right one. */
static void kernel_push_wheel(struct kernel_Body* c, struct kernel_BodyMotion* b, struct kernel_Wheel* k, struct kernel_WheelMotion* w, struct kernel_WheelMotion* other, double side, double steer, double torque, double dt)
{
    double v_x;
    double v_y;
    double v_z;
    double w_yaw;
    double w_pitch;
    double w_roll;
    double arm;
    double lever;
    double v_corner;
    double v_wheel;
    double stroke;
    double across;
    double velocity;
    double elastic;
    double pull;
    double press;
    double u_x;
    double u_y;
    double axle_roll;
    double at_x;
    double at_y;
    double angle;
    double cosine;
    double sine;
    double f_x;
    double f_y;
    double drive;
    double spin;
    double braked;
    double lift;
    double m;
    v_x = b->v_x + 0.5 * b->dv_x;
    v_y = b->v_y + 0.5 * b->dv_y;
    v_z = b->v_z + 0.5 * b->dv_z;
    w_yaw = b->w_yaw + 0.5 * b->dw_yaw;
    w_pitch = b->w_pitch + 0.5 * b->dw_pitch;
    w_roll = b->w_roll + 0.5 * b->dw_roll;
    arm = c->height - k->radius;
    lever = c->height - k->h_roll;
    v_corner = v_z + k->y * w_roll - k->x * w_pitch;
    v_wheel = w->v + 0.5 * w->dv;
    stroke = b->z + k->y * b->roll - k->x * b->pitch - w->z;
    across = b->z - k->y * b->roll - k->x * b->pitch - other->z;
    velocity = v_corner - v_wheel;
    elastic = k->c_body * stroke + k->c_bar * (stroke - across);
    pull = elastic + k->d_links * velocity + k->ratio * (w->acting - k->F_rest);
    pull += kernel_stop_force(k, stroke - k->travel, velocity) - kernel_stop_force(k, (-stroke) - k->travel, -velocity);
    press = k->weight + k->c_tyre * (w->road - w->z);
    w->load = press;
    if (press > 0.0)
    {
        w->load += k->d_tyre * (w->road_rate - v_wheel);
    }
    w->load = double_max(2, w->load, 0.0);
    /* Speeds of wheel centre and contact along and across the body. */
    u_x = v_x - k->y * w_yaw - arm * w_pitch;
    u_y = v_y + k->x * w_yaw + lever * w_roll;
    axle_roll = side * (v_wheel - other->v - 0.5 * other->dv) / k->track;
    at_x = u_x - k->support * velocity;
    at_y = u_y + k->h_roll * axle_roll;
    angle = k->steers * steer - k->steer_compliance * w->F_y;
    cosine = cos(angle);
    sine = sin(angle);
    kernel_roll_tyre(k, w, cosine * at_x + sine * at_y, cosine * at_y - sine * at_x, dt);
    f_x = cosine * w->F_x - sine * w->F_y;
    f_y = sine * w->F_x + cosine * w->F_y;
    drive = 0.5 * k->drive * torque;
    spin = w->spin + 0.5 * w->d_spin;
    braked = kernel_turn_wheel(k, w, drive, dt);
    lift = (-k->support) * f_x;
    b->q_x += f_x;
    b->q_y += f_y;
    b->q_yaw += k->x * f_y - k->y * f_x;
    b->q_z += lift - pull;
    b->q_pitch += k->x * (pull - lift) - arm * f_x - drive - braked;
    b->q_roll += k->y * (lift - pull) + lever * f_y;
    /* The mass of the wheel turns and is carried with the car. */
    m = k->m_wheel;
    b->q_x += m * w_yaw * u_y;
    b->q_y -= m * w_yaw * u_x;
    b->q_yaw -= m * w_yaw * (k->y * u_y + k->x * u_x);
    b->q_pitch -= m * arm * w_yaw * u_y;
    b->q_roll -= m * lever * w_yaw * u_x;
    b->q_roll += (k->weight - m * 9.80665) * lever * b->roll;
    b->m_all += m;
    b->m_x += m * k->x;
    b->m_h += m * arm;
    b->m_g += m * lever;
    b->m_xg += m * k->x * lever;
    b->i_pitch += m * arm * arm;
    b->i_yaw += m * (k->x * k->x + k->y * k->y);
    b->i_roll += m * lever * lever;
    /* What the tyre's lateral force does through the roll centre, half on either wheel of the axle. */
    w->lifted = pull + w->load - k->weight - lift;
    w->aside = side * f_y * k->h_roll / k->track;
    b->power += w->load * w->road_rate - (w->load - double_max(2, press, 0.0)) * (w->road_rate - v_wheel);
    b->power -= (pull - elastic) * velocity;
    b->power += f_x * at_x + f_y * at_y - w->F_x * k->radius * spin + k->c_x * w->e_x * w->de_x + k->c_y * w->e_y * w->de_y;
    b->power += (drive + braked) * (spin - w_pitch);
}

/* Move a wheel up or down: both wheels' lateral forces lift the left wheel and press the right one. */
static void kernel_lift_wheel(struct kernel_Wheel* k, struct kernel_WheelMotion* w, struct kernel_WheelMotion* other, double dt)
{
    w->dv = dt * (w->lifted + w->aside - other->aside) / k->m_wheel;
    w->v += w->dv;
    w->z += dt * w->v;
}

/* Move the body by what is summed up. Forward and pitch share a matrix, and so do aside, yaw and roll. */
static void kernel_move_body(struct kernel_Body* c, struct kernel_BodyMotion* b, double dt)
{
    double v_x;
    double v_y;
    double w_yaw;
    double determinant;
    double m11;
    double m12;
    double m13;
    double m22;
    double m23;
    double m33;
    double a11;
    double a12;
    double a13;
    double a22;
    double a23;
    double a33;
    double middle;
    v_x = b->v_x + 0.5 * b->dv_x;
    v_y = b->v_y + 0.5 * b->dv_y;
    w_yaw = b->w_yaw + 0.5 * b->dw_yaw;
    b->work += dt * b->power;
    determinant = b->m_all * b->i_pitch - b->m_h * b->m_h;
    b->dv_x = dt * (b->q_x * b->i_pitch + b->q_pitch * b->m_h) / determinant;
    b->dw_pitch = dt * (b->q_pitch * b->m_all + b->q_x * b->m_h) / determinant;
    m11 = b->m_all;
    m12 = b->m_x;
    m13 = b->m_g;
    m22 = b->i_yaw;
    m23 = b->m_xg;
    m33 = b->i_roll;
    a11 = m22 * m33 - m23 * m23;
    a12 = m13 * m23 - m12 * m33;
    a13 = m12 * m23 - m13 * m22;
    a22 = m11 * m33 - m13 * m13;
    a23 = m12 * m13 - m11 * m23;
    a33 = m11 * m22 - m12 * m12;
    determinant = m11 * a11 + m12 * a12 + m13 * a13;
    b->dv_y = dt * (a11 * b->q_y + a12 * b->q_yaw + a13 * b->q_roll) / determinant;
    b->dw_yaw = dt * (a12 * b->q_y + a22 * b->q_yaw + a23 * b->q_roll) / determinant;
    b->dw_roll = dt * (a13 * b->q_y + a23 * b->q_yaw + a33 * b->q_roll) / determinant;
    b->dv_z = dt * b->q_z / c->mass;
    b->a_x = b->dv_x / dt - w_yaw * v_y;
    b->a_y = b->dv_y / dt + w_yaw * v_x;
    b->v_x += b->dv_x;
    b->v_y += b->dv_y;
    b->v_z += b->dv_z;
    b->w_yaw += b->dw_yaw;
    b->w_pitch += b->dw_pitch;
    b->w_roll += b->dw_roll;
    middle = b->yaw + 0.5 * dt * b->w_yaw;
    b->x += dt * (b->v_x * cos(middle) - b->v_y * sin(middle));
    b->y += dt * (b->v_x * sin(middle) + b->v_y * cos(middle));
    b->yaw += dt * b->w_yaw;
    b->z += dt * b->v_z;
    b->pitch += dt * b->w_pitch;
    b->roll += dt * b->w_roll;
}

/* One leapfrog step of `dt` [s]; records of the wheels in the order of WHEELS.
   `steer` [rad] is the angle of the steered wheels, `torque` [N.m] that of the drive. Heights and rates of the road, the
   damper forces at the step's start (`acting`), grip and brake pressures stand in `w1` to `w4`. */
static void kernel_car_step(struct kernel_Body* c, struct kernel_BodyMotion* b, struct kernel_Wheel* k1, struct kernel_Wheel* k2, struct kernel_Wheel* k3, struct kernel_Wheel* k4, struct kernel_WheelMotion* w1, struct kernel_WheelMotion* w2, struct kernel_WheelMotion* w3, struct kernel_WheelMotion* w4, double steer, double torque, double dt)
{
    kernel_begin_sums(c, b);
    kernel_push_wheel(c, b, k1, w1, w2, 1.0, steer, torque, dt);
    kernel_push_wheel(c, b, k2, w2, w1, -1.0, steer, torque, dt);
    kernel_push_wheel(c, b, k3, w3, w4, 1.0, steer, torque, dt);
    kernel_push_wheel(c, b, k4, w4, w3, -1.0, steer, torque, dt);
    kernel_lift_wheel(k1, w1, w2, dt);
    kernel_lift_wheel(k2, w2, w1, dt);
    kernel_lift_wheel(k3, w3, w4, dt);
    kernel_lift_wheel(k4, w4, w3, dt);
    kernel_move_body(c, b, dt);
}

/* Drive torque [N.m] by which the driver holds the `wanted` speed [m/s] over `dt` [s]; none where that is 0. */
static double kernel_hold_speed(struct kernel_BodyMotion* b, double radius, double speed, double wanted, double dt)
{
    if (wanted <= 0.0)
    {
        return 0.0;
    }
    b->behind += dt * (wanted - speed);
    return radius * (6000.0 * (wanted - speed) + 2000.0 * b->behind);
}

/* One step of car, brakes and driver; road and damper forces stand in `w1` to `w4`.
   The driver steers by `steer` [rad], wants the brake `pressure` [Pa] and the `wanted` speed [m/s]; `torque` [N.m] comes on
   top of what holds the speed. */
static void kernel_drive_step(struct kernel_Body* c, struct kernel_BodyMotion* b, struct kernel_Wheel* k1, struct kernel_Wheel* k2, struct kernel_Wheel* k3, struct kernel_Wheel* k4, struct kernel_WheelMotion* w1, struct kernel_WheelMotion* w2, struct kernel_WheelMotion* w3, struct kernel_WheelMotion* w4, struct kernel_Brakes* h, double steer, double pressure, double wanted, double torque, double dt)
{
    double speed;
    double whole;
    speed = b->v_x + 0.5 * b->dv_x;
    kernel_seen_speed(h, b, k1->radius * w1->spin, k2->radius * w2->spin, k3->radius * w3->spin, k4->radius * w4->spin, dt);
    kernel_control_brake(h, k1, w1, b->seen, pressure, dt);
    kernel_control_brake(h, k2, w2, b->seen, pressure, dt);
    kernel_control_brake(h, k3, w3, b->seen, pressure, dt);
    kernel_control_brake(h, k4, w4, b->seen, pressure, dt);
    whole = torque + kernel_hold_speed(b, k1->radius, speed, wanted, dt);
    kernel_car_step(c, b, k1, k2, k3, k4, w1, w2, w3, w4, steer, whole, dt);
}

/* A communication step of `span` [s] in parts of at most 0.001; inputs are those at its start. */
static void kernel_communication_step(struct kernel_Body* c, struct kernel_BodyMotion* b, struct kernel_Wheel* k1, struct kernel_Wheel* k2, struct kernel_Wheel* k3, struct kernel_Wheel* k4, struct kernel_WheelMotion* w1, struct kernel_WheelMotion* w2, struct kernel_WheelMotion* w3, struct kernel_WheelMotion* w4, struct kernel_Brakes* h, struct kernel_DriverInputs* i, struct kernel_WheelInputs* j1, struct kernel_WheelInputs* j2, struct kernel_WheelInputs* j3, struct kernel_WheelInputs* j4, struct kernel_Course* t, double span)
{
    int64_t parts;
    double dt;
    double earlier;
    double apart;
    int64_t n;
    double at;
    double ahead;
    if (span <= 1e-09)
    {
        return;
    }
    parts = int64_t_max(2, 1, (int64_t)ceil(span / 0.001 - 1e-06));
    dt = span / parts;
    if ((t->part > 0.0) && (t->part != dt))
    {
        kernel_change_part(b, w1, w2, w3, w4, dt / t->part);
    }
    kernel_take_force(w1, j1);
    kernel_take_force(w2, j2);
    kernel_take_force(w3, j3);
    kernel_take_force(w4, j4);
    /* The force at the start is that of a rest before it, as long as a step. */
    earlier = (t->earlier > 0.0 ? t->earlier : t->span);
    apart = 0.5 * (t->span + earlier);
    for (n = 0; n < parts; n += 1)
    {
        at = n * dt;
        ahead = ((apart > 0.0) && (span <= 0.004) ? (0.5 * t->span + at) / apart : 0.0);
        kernel_meet_road(w1, j1, i->grip, ahead, at);
        kernel_meet_road(w2, j2, i->grip, ahead, at);
        kernel_meet_road(w3, j3, i->grip, ahead, at);
        kernel_meet_road(w4, j4, i->grip, ahead, at);
        kernel_drive_step(c, b, k1, k2, k3, k4, w1, w2, w3, w4, h, i->steer, i->brake_pressure, i->speed, i->torque, dt);
    }
    t->earlier = t->span;
    t->span = span;
    t->part = dt;
}

/* Fill `o` after a step. */
static void kernel_publish_body(struct kernel_BodyMotion* b, struct kernel_BodyOutputs* o, struct kernel_Course* t)
{
    o->x = b->x;
    o->y = b->y;
    o->z = b->z;
    o->yaw = b->yaw;
    o->pitch = b->pitch;
    o->roll = b->roll;
    o->v_x = b->v_x + 0.5 * b->dv_x;
    o->v_y = b->v_y + 0.5 * b->dv_y;
    o->v_z = b->v_z + 0.5 * b->dv_z;
    o->yaw_rate = b->w_yaw + 0.5 * b->dw_yaw;
    o->a_x = b->a_x;
    o->a_y = b->a_y;
    o->a_z = (t->part > 0.0 ? b->dv_z / t->part : 0.0);
}

/* Stroke of a wheel against the body [m], positive in rebound. */
static double kernel_corner_stroke(struct kernel_BodyMotion* b, struct kernel_Wheel* k, struct kernel_WheelMotion* w)
{
    return b->z + k->y * b->roll - k->x * b->pitch - w->z;
}

/* Mean velocity of that stroke [m/s] over the step to come: after `car_step` the speeds are half a step ahead. */
static double kernel_corner_velocity(struct kernel_BodyMotion* b, struct kernel_Wheel* k, struct kernel_WheelMotion* w)
{
    return b->v_z + k->y * b->w_roll - k->x * b->w_pitch - w->v;
}

/* Fill `o` after a step. */
static void kernel_publish_wheel(struct kernel_BodyMotion* b, struct kernel_Wheel* k, struct kernel_WheelMotion* w, struct kernel_WheelOutputs* o, struct kernel_Course* t)
{
    double change;
    double parts;
    change = b->dv_z + k->y * b->dw_roll - k->x * b->dw_pitch - w->dv;
    parts = (t->part > 0.0 ? t->span / t->part : 1.0);
    o->stroke = k->ratio * kernel_corner_stroke(b, k, w);
    o->velocity = k->ratio * (kernel_corner_velocity(b, k, w) + 0.5 * (1.0 + parts) * change);
    o->height = w->z;
    o->load = (t->part > 0.0 ? w->load : k->weight);
    o->F_x = w->F_x;
    o->F_y = w->F_y;
    o->slip_x = w->slip_x;
    o->slip_y = w->slip_y;
    o->spin = w->spin + 0.5 * w->d_spin;
    o->pressure = w->pressure;
}

/* Difference [s] of two communication points that is rounding: importers add up their steps, and end on a rest. */
static double kernel_time_slack(double time, double step)
{
    return 1e-09 * (1.0 + fabs(time)) + 0.001 * step;
}

/* The end of the play [m] where a place is beyond it, else the place. */
static double kernel_within_play(double place)
{
    if (place > 0.002)
    {
        return 0.002;
    }
    return (place < -0.002 ? -0.002 : place);
}

/* 1 where the ways up to this communication point do not belong together, else 0; `step` [s] is that to the next one.
   Where the velocity rises or falls all the way to the next point, the trapezoid misses at most half a step times its
   change. That covers a velocity that only comes with the first step, and one that is the mean of the coming step. Where it
   turns in between, the change itself changes. */
static int64_t kernel_parted(struct kernel_Agreement* a, double stroke, double velocity, double step)
{
    double way;
    double led;
    bool jumped;
    double change;
    double place;
    double whole;
    way = stroke - a->stroke;
    led = 0.5 * a->step * (a->velocity + velocity);
    jumped = fabs(way - led) > 0.02 + 20.0 * a->step;
    change = velocity - a->velocity;
    a->doubt += 0.5 * a->step * (fabs(change) + fabs(change - a->change));
    /* What changes in no time, at the start or between two steps, says nothing of the course. */
    a->change = (a->step > 0.0 ? change : 0.0);
    a->stroke = stroke;
    a->velocity = velocity;
    a->step = step;
    place = a->at_stroke + way;
    a->at_stroke = kernel_within_play(place);
    a->way_stroke += fabs(place - a->at_stroke);
    place = a->at_led + led;
    a->at_led = kernel_within_play(place);
    a->way_led += fabs(place - a->at_led);
    place = a->at_apart + way - led;
    a->at_apart = kernel_within_play(place);
    a->way_apart += fabs(place - a->at_apart);
    whole = double_max(2, a->way_stroke, a->way_led);
    if (jumped || ((whole >= 0.02) && (a->way_apart > a->doubt + 0.2 * whole)))
    {
        return 1;
    }
    if ((whole > 0.12) || (a->doubt > 2.0 * 0.12))
    {
        a->way_stroke *= 0.5;
        a->way_led *= 0.5;
        a->way_apart *= 0.5;
        a->doubt *= 0.5;
    }
    return 0;
}

/* 1 where a restored record can come from following inputs, else 0. */
static int64_t kernel_followed(struct kernel_Agreement* a)
{
    double sums;
    if ((fabs(a->at_stroke) > 0.002) || (fabs(a->at_led) > 0.002) || (fabs(a->at_apart) > 0.002))
    {
        return 0;
    }
    if ((a->step < 0.0) || (a->way_stroke < 0.0) || (a->way_led < 0.0) || (a->way_apart < 0.0) || (a->doubt < 0.0))
    {
        return 0;
    }
    sums = a->way_stroke + a->way_led + a->way_apart + a->doubt;
    return (fabs(a->stroke) + fabs(a->velocity) + fabs(a->change) + a->step + sums < 1e+17 ? 1 : 0);
}

#endif

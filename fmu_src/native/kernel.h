/* Written by twintube/fmu/translate.py from the equations c73216210f1b233f, body 0d5f0bdcbd885fff; do not edit. */
#ifndef KERNEL_H
#define KERNEL_H

#include "subset.h"

struct kernel_Parameters {
    double oil_level;
    int64_t gas_preload;
    double D_a;
    double D_PR;
    double D_li;
    double D_la;
    double h_l;
    double dead_length;
    double V_oil;
    double stroke_max;
    array_double_1d v_re;
    array_double_1d F_re;
    array_double_1d v_co;
    array_double_1d F_co;
    double F_FrS;
    double sigma_0;
    double delta_D;
    double k_high;
    double v_S;
    double oil_loss_gain;
    double F_0;
    double c_gas;
    double c_gas_lost;
    int64_t polytropic;
    double n_gas;
    double X_Re;
    double L_PV;
    double G_PV;
    double X_Co1;
    double X_Co2;
    double S_BV;
    double S_BVoil;
    double S_PV;
    double S_PVoil;
    double B;
    double E;
    double v_foam;
    double v_cav;
    double Y_Co_cav;
    double Y_Re_cav;
    int64_t leak_carries_oil;
    int64_t foam_leaves_with_gas;
    int64_t foam_decays;
    int64_t cavitation_foams;
    int64_t venting;
    double cavitation_loss;
    double F_stop_re;
    double onset_re;
    double F_stop_co;
    double onset_co;
    double power_stop;
    double loss_stop;
    double C_fluid;
    double C_fluid_co;
    double V_air;
    double tau_fluid;
    double closing_stroke;
    double relief_first;
    double air_at_rest;
    double column_share;
    double foam_decay_rate;
    double foam_order;
    double dry_share;
    double exhaustion;
    double redissolution_rate;
    double reserve_share;
    double pressed_share;
    double F_surplus;
    double c_residual;
    double F_residual;
    double C_mount;
    double tau_mount;
    double hardening;
    double m_rod;
    double displaced_share;
    double level_error;
    double fade_heat;
    double cooling_time;
    double H_start;
    double fade_kelvin;
    double friction_kelvin;
    double gas_kelvin;
    double turbulence;
    double thin_density;
    double gas_heat;
    double friction_slope;
    double friction_bow;
    double friction_spot;
    double spot_at;
    double spot_width;
    double leak_film;
    double leak_power;
    double leak_beyond;
    double cut_area;
    double side_load;
    double v_side;
    double side_lever;
    double build_up;
    double tau_build;
    double early_share;
    double carry_over;
    double carry_turn;
    double wear_re;
    double wear_co;
    double bleed_re;
    double bleed_co;
    double opening_re;
    double opening_co;
    double opening_speed;
    double bleed_laminar;
};

struct kernel_Derived {
    double A_1;
    double A_2;
    double A_rod;
    double half_length;
    double V_reserve;
    double F_FrS;
    double F_0;
    double c_gas;
    double W_kPV;
    double W_kBV_1;
    double W_kBV_2;
    double k_Co2;
    double Y_Co;
    double Y_Re;
    double cavitation;
    int64_t extended;
};

struct kernel_State {
    double z;
    double V1_oil;
    double V1_gas;
    double V1_foam;
    double V1_foam_oil;
    double V2_oil;
    double V2_gas;
    double V2_foam;
    double V2_foam_oil;
    double V3_oil;
    double V3_foam;
    double V3_foam_oil;
    double V_cav;
    double F_D;
    double k_degr;
    double F_fluid;
    double F_friction;
    double F_gas;
    double work;
    double z_rod;
    double goal_z;
    double goal_v0;
    double goal_v1;
    double k_flow;
    double k_re;
    double k_co;
    double impulse;
    double F_valve;
    double F_mean;
    double k_mean;
    double W_step;
    double warm;
    double duration;
    double elapsed;
    double F_held_re;
    double F_held_co;
    double F_turn_re;
    double F_turn_co;
    double F_late;
    double closed;
    double closing_side;
    double k_held_re;
    double k_held_co;
    double x_mount;
    double v_piston;
    double u_valve;
    double F_open;
    double F_mount;
    double F_rod;
    double x_begun;
    double z_begun;
    double z_end;
    double F_D_begun;
    double F_before;
    double k_used_re;
    double k_used_co;
    double F_middle;
    double rubbing;
    double end_share;
    double F_even;
    double moved;
    double felt_slope;
    double heat;
    double V_lost;
    double k_side;
    double gas_ahead;
    double foam_ahead;
    double vent_ahead;
    double rise_gas_re;
    double rise_gas_co;
    double rise_foam_re;
    double rise_foam_co;
    double rise_vent;
    double since_turn;
    double k_last;
    double k_end_re;
    double k_end_co;
    double k_target;
    double k_carried;
};

struct kernel_Flow {
    double V1_oil;
    double V1_gas;
    double V1_foam;
    double V1_foam_oil;
    double V2_oil;
    double V2_gas;
    double V2_foam;
    double V2_foam_oil;
    double V3_oil;
    double V3_foam;
    double V3_foam_oil;
    double cavitated;
    double k_degr;
    double k_mean;
};

struct kernel_Outputs {
    double force;
    double k_degr;
    double F_fluid;
    double F_friction;
    double F_gas;
    double work;
    double V1_oil;
    double V1_gas;
    double V1_foam;
    double V2_oil;
    double V2_gas;
    double V2_foam;
    double V3_oil;
    double V3_gas;
    double V3_foam;
    double V_cav;
};

struct kernel_Violation {
    int64_t point;
    double value;
    double limit;
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

/* Cavitation shares where the `share` [1] of the gas can be freed; the paper knows no limit, 1. */
static void kernel_cavitate(struct kernel_Parameters* p, struct kernel_Derived* d, double share)
{
    d->Y_Co = share * d->cavitation * p->Y_Co_cav;
    d->Y_Re = share * d->cavitation * p->Y_Re_cav;
}

/* Friction and cavitation shares of a damper that holds `oil_level` [1] of its oil. */
static void kernel_lose(struct kernel_Parameters* p, struct kernel_Derived* d, double oil_level)
{
    double loss;
    /* Section 3.2: "In case of oil loss, the friction force of the SA increases". */
    d->F_FrS = p->F_FrS * (1.0 + p->oil_loss_gain * (1.0 - oil_level));
    /* Section 3.2: the force falls from oscillation to oscillation when the damper "contains less than 100 % oil". Beside the */
    /* preload it takes gas in the place of oil: in proportion to the loss, in full from `cavitation_loss` on. */
    d->cavitation = 0.0;
    if (p->gas_preload == 0)
    {
        loss = 1.0 - oil_level;
        d->cavitation = (loss >= p->cavitation_loss ? 1.0 : loss / p->cavitation_loss);
    }
    kernel_cavitate(p, d, 1.0);
}

/* Fill `d` from `p`; to be called again after a parameter has changed. */
static void kernel_prepare(struct kernel_Parameters* p, struct kernel_Derived* d)
{
    double lost;
    double a;
    d->A_rod = 0.25 * M_PI * p->D_PR * p->D_PR;
    d->A_2 = 0.25 * M_PI * p->D_li * p->D_li;
    d->A_1 = d->A_2 - d->A_rod;
    d->half_length = 0.5 * (p->h_l - p->dead_length);
    d->V_reserve = 0.25 * M_PI * (p->D_a * p->D_a - p->D_la * p->D_la) * p->h_l;
    lost = 1.0 - p->gas_preload;
    d->F_0 = p->gas_preload * p->F_0;
    d->c_gas = p->gas_preload * p->c_gas + lost * p->c_gas_lost;
    kernel_lose(p, d, p->oil_level);
    /* Eq. 22: W_kPV reaches its target within one step. Reading B adds the leak to the flow; the force stays X_Re. */
    d->W_kPV = (1.0 - p->L_PV) * p->X_Re + p->leak_carries_oil * p->L_PV;
    a = d->A_1 / d->A_2;
    /* Eq. 27 */
    d->W_kBV_1 = (1.0 - a) * p->X_Co1;
    /* Eq. 28 */
    d->W_kBV_2 = (1.0 - a) * p->X_Co2;
    /* Eq. 29: W_kBV/(1 - a) + G_PV ((1 - W_kBV) - a)/(1 - a), free of 0/0 where a is 1 */
    d->k_Co2 = p->X_Co2 + p->G_PV * (1.0 - p->X_Co2);
}

static int64_t kernel_effects_active(struct kernel_Parameters* p)
{
    if (p->level_error != 0.0)
    {
        return 1;
    }
    if (p->foam_decay_rate != 0.0)
    {
        return 1;
    }
    if (p->redissolution_rate != 0.0)
    {
        return 1;
    }
    if ((p->leak_film != 0.0) || (p->cut_area != 0.0))
    {
        return 1;
    }
    if (p->exhaustion != 0.0)
    {
        return 1;
    }
    if (p->displaced_share != 0.0)
    {
        return 1;
    }
    if ((p->F_stop_re != 0.0) || (p->F_stop_co != 0.0))
    {
        return 1;
    }
    if ((p->F_surplus != 0.0) || (p->c_residual != 0.0) || (p->F_residual != 0.0))
    {
        return 1;
    }
    if ((p->fade_heat != 0.0) || (p->fade_kelvin != 0.0) || (p->friction_kelvin != 0.0))
    {
        return 1;
    }
    if ((p->friction_slope != 0.0) || (p->friction_bow != 0.0) || (p->friction_spot != 0.0))
    {
        return 1;
    }
    if (p->side_load != 0.0)
    {
        return 1;
    }
    if ((p->wear_re != 0.0) || (p->wear_co != 0.0) || (p->bleed_re != 0.0) || (p->bleed_co != 0.0) || (p->opening_re != 0.0) || (p->opening_co != 0.0))
    {
        return 1;
    }
    if ((p->C_fluid != 0.0) || (p->C_fluid_co != 0.0) || (p->V_air != 0.0) || (p->tau_fluid != 0.0) || (p->closing_stroke != 0.0))
    {
        return 1;
    }
    if ((p->build_up != 0.0) || (p->tau_build != 0.0))
    {
        return 1;
    }
    if (p->C_mount != 0.0)
    {
        return 1;
    }
    return 0;
}

/* The true level [1]. */
static double kernel_oil_level_error_level(struct kernel_Parameters* p, double level)
{
    return (p->gas_preload == 0 ? double_max(2, 0.0, double_min(2, 1.0, level + p->level_error)) : level);
}

/* What follows from the oil that is truly lost. */
static void kernel_oil_level_error_derive(struct kernel_Parameters* p, struct kernel_Derived* d)
{
    kernel_lose(p, d, kernel_oil_level_error_level(p, p->oil_level));
}

static void kernel_effects_derive(struct kernel_Parameters* p, struct kernel_Derived* d)
{
    if (p->level_error != 0.0)
    {
        kernel_oil_level_error_derive(p, d);
    }
    return;
}

/* Fill `d` from `p`; to be called again after a parameter has changed. */
static void kernel_set_up(struct kernel_Parameters* p, struct kernel_Derived* d)
{
    kernel_prepare(p, d);
    d->extended = kernel_effects_active(p);
    if (d->extended > 0)
    {
        kernel_effects_derive(p, d);
    }
}

/* Gas force [N] at the stroke `z` [m] beyond `F_0` [N], that at stroke 0, where `c_gas` [N/m] is the stiffness.
   Beyond the paper, with `polytropic`: at stroke 0 the gas has the absolute pressure 100000.0 + F_0/A_rod and the volume
   that makes `c_gas` its stiffness when it is compressed slowly. Beyond the maximum stroke, where a damper has stops and
   the gas may have no room left, the force goes on along its tangent. */
static double kernel_gas_rise(struct kernel_Parameters* p, double F_0, double c_gas, double z)
{
    double whole;
    double inside;
    double volume;
    double pressure;
    double rise;
    rise = c_gas * z;
    if (p->polytropic > 0)
    {
        whole = F_0 + 100000.0 * 0.25 * M_PI * p->D_PR * p->D_PR;
        inside = double_max(2, z, -p->stroke_max);
        volume = 1.0 + c_gas * inside / whole;
        pressure = exp((-p->n_gas) * log(volume));
        rise = whole * (1.0 - pressure) + p->n_gas * c_gas * pressure / volume * (z - inside);
    }
    return rise;
}

/* As `fill`, with the volume `oil` [m3]. */
static void kernel_pour(struct kernel_Parameters* p, struct kernel_Derived* d, struct kernel_State* s, double z, double oil)
{
    double V1;
    double V2;
    V1 = d->A_1 * (d->half_length - z);
    V2 = d->A_2 * (d->half_length + z);
    s->z = z;
    s->V2_oil = double_min(2, oil, V2);
    s->V1_oil = double_min(2, oil - s->V2_oil, V1);
    s->V3_oil = oil - s->V2_oil - s->V1_oil;
    s->V1_gas = V1 - s->V1_oil;
    s->V2_gas = V2 - s->V2_oil;
    s->V1_foam = 0.0;
    s->V1_foam_oil = 0.0;
    s->V2_foam = 0.0;
    s->V2_foam_oil = 0.0;
    s->V3_foam = 0.0;
    s->V3_foam_oil = 0.0;
    s->V_cav = 0.0;
    s->F_D = 0.0;
    s->k_degr = 1.0;
    s->F_fluid = 0.0;
    s->F_friction = 0.0;
    s->F_gas = kernel_gas_rise(p, d->F_0, d->c_gas, z) - d->F_0;
    s->work = 0.0;
}

static void kernel_effects_reset(struct kernel_State* s)
{
    s->z_rod = 0.0;
    s->goal_z = 0.0;
    s->goal_v0 = 0.0;
    s->goal_v1 = 0.0;
    s->k_flow = 1.0;
    s->k_re = 1.0;
    s->k_co = 1.0;
    s->impulse = 0.0;
    s->F_valve = 0.0;
    s->F_mean = 0.0;
    s->k_mean = 1.0;
    s->W_step = 0.0;
    s->warm = 0.0;
    s->duration = 0.0;
    s->elapsed = 0.0;
    s->F_held_re = 0.0;
    s->F_held_co = 0.0;
    s->F_turn_re = 0.0;
    s->F_turn_co = 0.0;
    s->F_late = 0.0;
    s->closed = 1.0;
    s->closing_side = 0.0;
    s->k_held_re = 1.0;
    s->k_held_co = 1.0;
    s->x_mount = 0.0;
    s->v_piston = 0.0;
    s->u_valve = 0.0;
    s->F_open = 0.0;
    s->F_mount = 0.0;
    s->F_rod = 0.0;
    s->x_begun = 0.0;
    s->z_begun = 0.0;
    s->z_end = 0.0;
    s->F_D_begun = 0.0;
    s->F_before = 0.0;
    s->k_used_re = 1.0;
    s->k_used_co = 1.0;
    s->F_middle = 0.0;
    s->rubbing = 1.0;
    s->end_share = 1.0;
    s->F_even = 0.0;
    s->moved = 1.0;
    s->felt_slope = 0.0;
    s->heat = 0.0;
    s->V_lost = 0.0;
    s->k_side = 0.0;
    s->gas_ahead = 0.0;
    s->foam_ahead = 0.0;
    s->vent_ahead = 0.0;
    s->rise_gas_re = 1.0;
    s->rise_gas_co = 1.0;
    s->rise_foam_re = 0.0;
    s->rise_foam_co = 0.0;
    s->rise_vent = 0.0;
    s->since_turn = 0.0;
    s->k_last = 1.0;
    s->k_end_re = -1.0;
    s->k_end_co = -1.0;
    s->k_target = 1.0;
    s->k_carried = 0.0;
}

/* Force [N] of a stop pressed by `over` [m]. */
static double kernel_end_stop_press(struct kernel_Parameters* p, double force, double over)
{
    if (over <= 0.0)
    {
        return 0.0;
    }
    return force * exp(p->power_stop * log(over / 0.01));
}

/* Force [N] at the stroke `z` [m]. */
static double kernel_end_stop_elastic(struct kernel_Parameters* p, struct kernel_State* s, double z)
{
    return kernel_end_stop_press(p, p->F_stop_re, z - p->onset_re) - kernel_end_stop_press(p, p->F_stop_co, (-z) - p->onset_co);
}

/* Force [N] at the stroke `z` [m]. */
static double kernel_gas_spring_elastic(struct kernel_Parameters* p, struct kernel_State* s, double z)
{
    double whole;
    if (p->gas_preload > 0)
    {
        whole = p->F_0 + 100000.0 * 0.25 * M_PI * p->D_PR * p->D_PR;
        return p->F_surplus * (kernel_gas_rise(p, p->F_0, p->c_gas, z) / whole - 1.0);
    }
    return p->c_residual * z - p->F_residual;
}

/* Force [N] by which that of the preload changes at the stroke `z` [m]. */
static double kernel_oil_temperature_elastic(struct kernel_Parameters* p, struct kernel_State* s, double z)
{
    double hotter;
    hotter = p->gas_kelvin * s->warm + p->gas_heat * (p->H_start + s->heat);
    return p->gas_preload * hotter * (kernel_gas_rise(p, p->F_0, p->c_gas, z) - p->F_0);
}

static double kernel_effects_elastic(struct kernel_Parameters* p, struct kernel_State* s, double z)
{
    double value;
    value = 0.0;
    if ((p->F_stop_re != 0.0) || (p->F_stop_co != 0.0))
    {
        value += kernel_end_stop_elastic(p, s, z);
    }
    if ((p->F_surplus != 0.0) || (p->c_residual != 0.0) || (p->F_residual != 0.0))
    {
        value += kernel_gas_spring_elastic(p, s, z);
    }
    if ((p->fade_heat != 0.0) || (p->fade_kelvin != 0.0) || (p->friction_kelvin != 0.0))
    {
        value += kernel_oil_temperature_elastic(p, s, z);
    }
    return value;
}

/* The state at rest at the stroke `z` [m]: oil fills V2, then V1, the rest is in the reserve; no foam.
   The order no longer matters after the paper's six preconditioning oscillations. */
static void kernel_fill(struct kernel_Parameters* p, struct kernel_Derived* d, struct kernel_State* s, double z)
{
    kernel_pour(p, d, s, z, p->oil_level * p->V_oil);
}

static double kernel_effects_level(struct kernel_Parameters* p, double value)
{
    if (p->level_error != 0.0)
    {
        value = kernel_oil_level_error_level(p, value);
    }
    return value;
}

/* The state at rest at the stroke `z` [m]. */
static void kernel_start(struct kernel_Parameters* p, struct kernel_Derived* d, struct kernel_State* s, double z)
{
    if (d->extended == 0)
    {
        kernel_fill(p, d, s, z);
        return;
    }
    kernel_pour(p, d, s, z, kernel_effects_level(p, p->oil_level) * p->V_oil);
    kernel_effects_reset(s);
    s->z_rod = z;
    s->F_gas += kernel_effects_elastic(p, s, z);
}

/* Where a rod at the stroke `at` [m] goes that is sent to `z` [m] at velocities from `v0` to `v1` [m/s].
   A stroke behind the way that the velocity has led - rounding, noise of a sensor, a velocity that was held for a step - is
   no reversal: the rod waits until the motion has caught up with it, and it stands where the velocity is 0. As for
   `agreement`, a way begins beyond the play: such a jump is followed. */
static double kernel_rod_goal(double at, double z, double v0, double v1)
{
    bool behind;
    behind = ((z < at) && (v0 >= 0.0) && (v1 >= 0.0)) || ((z > at) && (v0 <= 0.0) && (v1 <= 0.0));
    return (behind && (fabs(z - at) <= 0.002) ? at : z);
}

/* Number of parts for a step of `dt` [s]. */
static int64_t kernel_parts_of(double dt)
{
    /* The smaller one first: C has no integer for the number of parts of a very long step. */
    return int64_t_max(2, 1, (int64_t)ceil(double_min(2, 4.0, dt / 0.0006 - 1e-06)));
}

/* The force settles within milliseconds. */
static int64_t kernel_fluid_lag_parts(struct kernel_Parameters* p, double dt)
{
    return kernel_parts_of(dt);
}

/* The deflection settles within milliseconds, and the phases lag by a part where k_degr steps. */
static int64_t kernel_mount_compliance_parts(struct kernel_Parameters* p, double dt)
{
    return kernel_parts_of(dt);
}

static int64_t kernel_effects_parts(struct kernel_Parameters* p, double dt)
{
    int64_t value;
    value = 1;
    if ((p->C_fluid != 0.0) || (p->C_fluid_co != 0.0) || (p->V_air != 0.0) || (p->tau_fluid != 0.0) || (p->closing_stroke != 0.0))
    {
        value = int64_t_max(2, value, kernel_fluid_lag_parts(p, dt));
    }
    if (p->C_mount != 0.0)
    {
        value = int64_t_max(2, value, kernel_mount_compliance_parts(p, dt));
    }
    return value;
}

/* Force [N] of one branch of the F-v curve at the speed `v` >= 0 [m/s]; the last segment goes on beyond it. */
static double kernel_branch(double v, array_double_1d velocities, array_double_1d forces)
{
    int64_t i;
    double slope;
    double result;
    i = 0;
    while((i < 20 - 1) && ((*cspan_at(&velocities, i)) < v))
    {
        i += 1;
    }
    if (i == 0)
    {
        result = (*cspan_at(&forces, 0)) * v / (*cspan_at(&velocities, 0));
        return result;
    }
    slope = ((*cspan_at(&forces, i)) - (*cspan_at(&forces, i - 1))) / ((*cspan_at(&velocities, i)) - (*cspan_at(&velocities, i - 1)));
    result = (*cspan_at(&forces, i - 1)) + slope * (v - (*cspan_at(&velocities, i - 1)));
    return result;
}

/* Friction-reduced force of the intact damper [N] at the velocity `v` [m/s]. */
static double kernel_fluid_force(struct kernel_Parameters* p, double v)
{
    double result;
    /* Eq. 3: A2*p2 - A1*p1 explains this force; as in the paper the measured F-v curve stands for it. */
    if (v >= 0.0)
    {
        result = kernel_branch(v, p->v_re, p->F_re);
        return result;
    }
    result = -kernel_branch(-v, p->v_co, p->F_co);
    return result;
}

/* Fluid force [N] while the oil passes the valves as at the piston speed `u` [m/s]; it rises with `u`. */
static double kernel_valve_force(struct kernel_Parameters* p, double u, double k_re, double k_co)
{
    return kernel_fluid_force(p, u) * ((u >= 0.0 ? k_re : k_co));
}

/* Speed [m/s] that a leak of `bleed` [m/s] takes at a force `F` >= 0 [N]. */
static double kernel_valve_wear_leak(struct kernel_Parameters* p, double bleed, double F)
{
    return bleed * ((1.0 - p->bleed_laminar) * sqrt(F / 1000.0) + p->bleed_laminar * F / 1000.0);
}

/* Force of one branch at the speed `u` > 0 [m/s] over that without a leak of `bleed` [m/s] [1]. */
static double kernel_valve_wear_share(struct kernel_Parameters* p, double u, double bleed, array_double_1d velocities, array_double_1d forces)
{
    int64_t i;
    double v;
    double F;
    double slope;
    double rest;
    double bend;
    double more;
    double whole;
    double y;
    i = 0;
    while((i < 20 - 1) && ((*cspan_at(&velocities, i)) + kernel_valve_wear_leak(p, bleed, (*cspan_at(&forces, i))) < u))
    {
        i += 1;
    }
    v = 0.0;
    F = 0.0;
    if (i > 0)
    {
        v = (*cspan_at(&velocities, i - 1));
        F = (*cspan_at(&forces, i - 1));
    }
    slope = ((*cspan_at(&forces, i)) - F) / ((*cspan_at(&velocities, i)) - v);
    /* y = sqrt(force): y^2 = F + slope (u - v - orifice y - gap y^2) has the positive root */
    rest = F + slope * (u - v);
    bend = slope * bleed * (1.0 - p->bleed_laminar) / sqrt(1000.0);
    more = 1.0 + slope * bleed * p->bleed_laminar / 1000.0;
    whole = kernel_branch(u, velocities, forces);
    if ((rest <= 0.0) || (whole <= 0.0))
    {
        return 1.0;
    }
    y = 2.0 * rest / (bend + sqrt(bend * bend + 4.0 * more * rest));
    return y * y / whole;
}

/* Factor of the intact fluid force [1] that the leak leaves at the speed `u` [m/s]. */
static double kernel_valve_wear_scale_valve(struct kernel_Parameters* p, double u)
{
    double result;
    if (u > 0.0)
    {
        result = (p->bleed_re > 0.0 ? kernel_valve_wear_share(p, u, p->bleed_re, p->v_re, p->F_re) : 1.0);
        return result;
    }
    if (u < 0.0)
    {
        result = (p->bleed_co > 0.0 ? kernel_valve_wear_share(p, -u, p->bleed_co, p->v_co, p->F_co) : 1.0);
        return result;
    }
    return 1.0;
}

static double kernel_effects_scale_valve(struct kernel_Parameters* p, double u)
{
    double value;
    value = 1.0;
    if ((p->wear_re != 0.0) || (p->wear_co != 0.0) || (p->bleed_re != 0.0) || (p->bleed_co != 0.0) || (p->opening_re != 0.0) || (p->opening_co != 0.0))
    {
        value *= kernel_valve_wear_scale_valve(p, u);
    }
    return value;
}

/* Fluid force [N] at the speed `u` [m/s] at the valves, with what passes beside them. */
static double kernel_mount_compliance_valves(struct kernel_Parameters* p, double u, double k_re, double k_co)
{
    return kernel_valve_force(p, u, k_re, k_co) * kernel_effects_scale_valve(p, u);
}

/* Scaling k_FrS [1] of the friction at the velocity `v` [m/s]; the shape of Figure 12 is assumed. */
static double kernel_stribeck(struct kernel_Parameters* p, double v)
{
    return p->k_high + (1.0 - p->k_high) * exp((-fabs(v)) / p->v_S);
}

/* Slope of the rubber's force over that of the undeflected rubber [1]. */
static double kernel_mount_compliance_harder(struct kernel_Parameters* p, struct kernel_State* s)
{
    return 1.0 + 3.0 * p->hardening * s->x_mount * s->x_mount;
}

/* Weight [1] of the rate at the end of a step of `q` time constants: the linear decay is met exactly (0.5 at 0, 1 late).
   Exponentially fitted theta method: Liniger and Willoughby 1970, SIAM Journal on Numerical Analysis 7. */
static double kernel_end_weight(double q)
{
    if (q < 0.001)
    {
        return 0.5 + q / 12.0;
    }
    if (q > 500.0)
    {
        return 1.0;
    }
    return 1.0 / (1.0 - exp(-q)) - 1.0 / q;
}

/* Fix what the search of a step needs; `rate` [m/s] is that of the deflection at its start.
   The mean rate of the step is (1 - end_share) rate + end_share times that at its end. */
static void kernel_mount_compliance_begin(struct kernel_Parameters* p, struct kernel_Derived* d, struct kernel_State* s, double z, double v, double rate, double dt)
{
    double settling;
    s->z_end = z;
    s->z_begun = s->z;
    s->F_D_begun = s->F_D;
    s->F_middle = kernel_effects_elastic(p, s, 0.0);
    s->rubbing = kernel_stribeck(p, v);
    settling = (p->tau_mount + p->C_mount * s->felt_slope / s->moved) / kernel_mount_compliance_harder(p, s);
    s->end_share = (settling > 0.0 ? kernel_end_weight(dt / settling) : 1.0);
    s->x_begun = s->x_mount + (1.0 - s->end_share) * rate * dt;
}

/* Force [N] behind late valves after `dt` [s] in which that of the columns was `F` [N]. */
static double kernel_fluid_lag_felt(struct kernel_Parameters* p, struct kernel_State* s, double F, double dt)
{
    if ((p->tau_fluid <= 0.0) || (dt <= 0.0))
    {
        return F;
    }
    return F + (s->F_late - F) * exp((-dt) / p->tau_fluid);
}

static double kernel_effects_felt(struct kernel_Parameters* p, struct kernel_State* s, double value, double dt)
{
    if ((p->C_fluid != 0.0) || (p->C_fluid_co != 0.0) || (p->V_air != 0.0) || (p->tau_fluid != 0.0) || (p->closing_stroke != 0.0))
    {
        value = kernel_fluid_lag_felt(p, s, value, dt);
    }
    return value;
}

/* Oil [1] of the column at the stroke `z` [m], in terms of that at stroke 0. */
static double kernel_column_length(struct kernel_Parameters* p, double side, double z)
{
    double out;
    double rod;
    out = p->column_share * z / (0.5 * (p->h_l - p->dead_length));
    if (side >= 0.0)
    {
        return 1.0 - out;
    }
    rod = p->D_PR * p->D_PR;
    return 1.0 + out * rod / (2.0 * p->D_li * p->D_li - rod);
}

/* Of the column at the stroke `z` [m]: compliance [m/N], stroke of its air [m], force that halves it [N]. */
static int64_t kernel_column_of(double* result_0_0001, double* result_1_0001, double* result_2_0001, struct kernel_Parameters* p, double side, double z)
{
    double rod;
    double bore;
    double pressure;
    double length;
    double air;
    rod = 0.25 * M_PI * p->D_PR * p->D_PR;
    bore = 0.25 * M_PI * p->D_li * p->D_li;
    pressure = 100000.0;
    length = kernel_column_length(p, side, z);
    air = p->V_air * length;
    if (p->gas_preload > 0)
    {
        pressure += p->F_0 / rod;
        air *= p->air_at_rest + (1.0 - p->air_at_rest) * 100000.0 / pressure;
    }
    if (side >= 0.0)
    {
        /* The share of the air that is above the piston, on the annulus. */
        (*result_0_0001) = p->C_fluid * length;
        (*result_1_0001) = air / (2.0 * bore - rod);
        (*result_2_0001) = pressure * (bore - rod);
        return 0;
    }
    (*result_0_0001) = p->C_fluid_co * length;
    (*result_1_0001) = air / rod;
    (*result_2_0001) = pressure * rod;
    return 0;
}

/* Stroke [m] by which a column gives under the force `F` [N], with its sign. */
static double kernel_column_stroke(double C, double way, double F_half, double F)
{
    return C * F + way * F / (fabs(F) + F_half);
}

/* Stroke [m] by which the column on the side of the force `F` [N] gives at the stroke `z` [m], with its sign. */
static double kernel_column_given(struct kernel_Parameters* p, double F, double z)
{
    double C;
    double way;
    double F_half;
    kernel_column_of(&C, &way, &F_half, p, F, z);
    return kernel_column_stroke(C, way, F_half, F);
}

/* Speed [m/s] at which the oil gives while its force goes to `F` [N] within `dt` > 0 [s]; for an element in series. */
static double kernel_fluid_lag_series(struct kernel_Parameters* p, struct kernel_State* s, double F, double dt)
{
    return (kernel_column_given(p, F, s->z) - kernel_column_given(p, s->F_held_re - s->F_held_co, s->z)) / dt;
}

static double kernel_effects_series(struct kernel_Parameters* p, struct kernel_State* s, double F, double dt)
{
    double value;
    value = 0.0;
    if ((p->C_fluid != 0.0) || (p->C_fluid_co != 0.0) || (p->V_air != 0.0) || (p->tau_fluid != 0.0) || (p->closing_stroke != 0.0))
    {
        value += kernel_fluid_lag_series(p, s, F, dt);
    }
    return value;
}

/* Dahl friction force [N] after the stroke `dz` [m]: the exact solution of equation 2 over the stroke. */
static double kernel_dahl(struct kernel_Parameters* p, struct kernel_Derived* d, double F_D, double dz)
{
    double direction;
    double gap;
    double side;
    double way;
    double size;
    double q;
    double left;
    if (d->F_FrS <= 1e-09)
    {
        return 0.0;
    }
    direction = (dz > 0.0 ? 1.0 : -1.0);
    gap = 1.0 - direction * F_D / d->F_FrS;
    side = (gap >= 0.0 ? 1.0 : -1.0);
    /* Eq. 2 divided by the velocity: d|gap|/d|z| = -(sigma_0/F_FrS) |gap|^delta_D */
    way = p->sigma_0 / d->F_FrS * fabs(dz);
    size = fabs(gap);
    if (size > 0.0)
    {
        q = 1.0 - p->delta_D;
        if (fabs(q) < 1e-06)
        {
            size *= exp(-way);
        }
        else
        {
            left = exp(q * log(size)) - q * way;
            size = (left > 0.0 ? exp(log(left) / q) : 0.0);
        }
    }
    return direction * d->F_FrS * (1.0 - side * size);
}

/* Share of the friction that is left [1]. */
static double kernel_oil_temperature_scale_friction(struct kernel_Parameters* p, struct kernel_State* s, double z, double v)
{
    return exp((-p->friction_kelvin) * (s->warm + p->H_start / 700.0));
}

/* Factor of the friction force [1] at the stroke `z` [m]. */
static double kernel_position_friction_scale_friction(struct kernel_Parameters* p, struct kernel_State* s, double z, double v)
{
    double x;
    x = (z - p->spot_at) / p->spot_width;
    return double_max(2, 0.0, 1.0 + z * (p->friction_slope + z * p->friction_bow) + p->friction_spot * exp((-x) * x));
}

/* Factor of the friction force [1] at the stroke `z` [m] and the velocity `v` [m/s]. */
static double kernel_side_load_friction_scale_friction(struct kernel_Parameters* p, struct kernel_State* s, double z, double v)
{
    double x;
    double pressed;
    x = v / p->v_side;
    pressed = p->side_load * double_max(2, 0.0, 1.0 + p->side_lever * z);
    return 1.0 + pressed * (1.0 - exp((-x) * x)) / (1.0 + p->oil_loss_gain * (1.0 - p->oil_level));
}

static double kernel_effects_scale_friction(struct kernel_Parameters* p, struct kernel_State* s, double z, double v)
{
    double value;
    value = 1.0;
    if ((p->fade_heat != 0.0) || (p->fade_kelvin != 0.0) || (p->friction_kelvin != 0.0))
    {
        value *= kernel_oil_temperature_scale_friction(p, s, z, v);
    }
    if ((p->friction_slope != 0.0) || (p->friction_bow != 0.0) || (p->friction_spot != 0.0))
    {
        value *= kernel_position_friction_scale_friction(p, s, z, v);
    }
    if (p->side_load != 0.0)
    {
        value *= kernel_side_load_friction_scale_friction(p, s, z, v);
    }
    return value;
}

/* Force [N] of the rubber's hysteresis at the stroke `z` [m] and the velocity `v` [m/s]. */
static double kernel_end_stop_rub(struct kernel_Parameters* p, double z, double v)
{
    double pressed;
    pressed = kernel_end_stop_press(p, p->F_stop_re, z - p->onset_re) + kernel_end_stop_press(p, p->F_stop_co, (-z) - p->onset_co);
    return p->loss_stop * pressed * tanh(v / 0.01);
}

static double kernel_effects_rub(struct kernel_Parameters* p, double z, double v)
{
    double value;
    value = 0.0;
    if ((p->F_stop_re != 0.0) || (p->F_stop_co != 0.0))
    {
        value += kernel_end_stop_rub(p, z, v);
    }
    return value;
}

/* Force of the rubber beyond that of the damper [N] if the step ends with the speed `u` [m/s] at the valves.
   Sets what belongs to that speed: the forces at the valves and behind them and the speed of the piston. */
static double kernel_mount_compliance_excess(struct kernel_Parameters* p, struct kernel_Derived* d, struct kernel_State* s, double v, double dt, double u)
{
    double rate;
    double x;
    double goal;
    double friction;
    double gas;
    s->F_open = kernel_mount_compliance_valves(p, u, s->k_re, s->k_co);
    s->F_mount = kernel_effects_felt(p, s, s->F_open, dt);
    s->goal_v1 = u + kernel_effects_series(p, s, s->F_open, dt);
    rate = v - s->goal_v1;
    x = s->x_begun + rate * s->end_share * dt;
    goal = s->z_end - x;
    friction = kernel_effects_scale_friction(p, s, goal, v) * s->rubbing * kernel_dahl(p, d, s->F_D_begun, goal - s->z_begun);
    gas = kernel_gas_rise(p, d->F_0, d->c_gas, goal) + kernel_effects_elastic(p, s, goal) - s->F_middle;
    return (x * (1.0 + p->hardening * x * x) + p->tau_mount * rate) / p->C_mount - s->F_mount - friction - kernel_effects_rub(p, goal, v) - gas - p->m_rod * (s->goal_v1 - s->v_piston) / dt;
}

/* The speed at the valves for which rubber and damper agree: secants between bounds that close in on it. */
static void kernel_mount_compliance_solve(struct kernel_Parameters* p, struct kernel_Derived* d, struct kernel_State* s, double v, double dt)
{
    double stiffness;
    double slope;
    double low;
    double high;
    double u;
    double r;
    int64_t n;
    double before;
    double r_before;
    double F;
    double speed;
    stiffness = kernel_mount_compliance_harder(p, s) / p->C_mount + d->c_gas + s->rubbing * p->sigma_0;
    slope = s->moved * (stiffness * s->end_share * dt + p->tau_mount / p->C_mount + p->m_rod / dt) + s->felt_slope;
    low = -50.0;
    high = 50.0;
    u = s->u_valve;
    r = kernel_mount_compliance_excess(p, d, s, v, dt, u);
    n = 0;
    while((n < 60) && (fabs(r) > 0.0001) && (low < high))
    {
        /* The excess falls with the speed. */
        if (r > 0.0)
        {
            low = u;
        }
        else
        {
            high = u;
        }
        before = u;
        r_before = r;
        F = s->F_mount;
        speed = s->goal_v1;
        u += r / double_max(2, slope, 1e-09);
        if (!((low < u) && (u < high)))
        {
            u = 0.5 * (low + high);
        }
        r = kernel_mount_compliance_excess(p, d, s, v, dt, u);
        if ((r != r_before) && (u != before))
        {
            slope = (r_before - r) / (u - before);
            s->moved = double_max(2, 1.0, (s->goal_v1 - speed) / (u - before));
            s->felt_slope = double_max(2, 0.0, (s->F_mount - F) / (u - before));
        }
        n += 1;
    }
    /* An undamped mount on late valves, whose force cannot follow, would have to move in no time: not beyond the bounds. */
    s->u_valve = u;
    s->x_mount = s->x_begun + (v - s->goal_v1) * s->end_share * dt;
}

/* Largest stroke [m] to each side that keeps the piston inside the tube. */
static double kernel_stroke_limit(struct kernel_Derived* d)
{
    return d->half_length - 1e-06;
}

/* Stroke and velocity of the piston; in a step without time the deflection stays. */
static void kernel_mount_compliance_motion(struct kernel_Parameters* p, struct kernel_Derived* d, struct kernel_State* s, double z, double v0, double v1, double dt)
{
    if (s->elapsed > 0.0)
    {
        s->goal_v0 = s->v_piston;
        s->goal_v1 = s->v_piston;
    }
    else
    {
        s->v_piston = v0;
        s->F_open = kernel_mount_compliance_valves(p, v0, s->k_re, s->k_co);
        s->F_mount = s->F_open;
    }
    s->F_before = s->F_mount;
    s->k_used_re = s->k_re;
    s->k_used_co = s->k_co;
    if (dt > 0.0)
    {
        kernel_mount_compliance_begin(p, d, s, z, v1, v0 - s->v_piston, dt);
        s->u_valve = double_max(2, -50.0, double_min(2, 50.0, s->u_valve + v1 - v0));
        kernel_mount_compliance_solve(p, d, s, v1, dt);
    }
    /* An elastic mount cannot push the piston out of the tube. */
    s->goal_z = double_max(2, -kernel_stroke_limit(d), double_min(2, kernel_stroke_limit(d), z - s->x_mount));
    if (((s->goal_z - s->z) * s->goal_v1 < 0.0) && (s->goal_v0 * s->goal_v1 > 0.0))
    {
        /* What is left of the deflection before a step of k_degr does not turn the piston round. */
        s->goal_z = s->z;
    }
}

static void kernel_effects_motion(struct kernel_Parameters* p, struct kernel_Derived* d, struct kernel_State* s, double z, double v0, double v1, double dt)
{
    if (p->C_mount != 0.0)
    {
        kernel_mount_compliance_motion(p, d, s, z, v0, v1, dt);
    }
    return;
}

/* Give the oil and the gas of the decayed foam back; the volumes of the chambers stay. */
static void kernel_foam_decay_phases(struct kernel_Parameters* p, struct kernel_State* s, double way, double dt)
{
    double rate;
    double foam;
    double drained;
    double burst;
    double oil;
    double gas;
    rate = p->foam_decay_rate;
    foam = s->V1_foam + s->V2_foam + s->V3_foam;
    if ((p->foam_order < 1.0) && (foam > 0.0))
    {
        rate *= pow(1e-05 / foam, 1.0 - p->foam_order);
    }
    drained = 1.0 - exp((-rate) * dt);
    burst = 1.0 - exp((-p->dry_share) * rate * dt);
    /* A trace of 1e-9 mL would still count as foam. */
    oil = (s->V1_foam < 1e-15 ? s->V1_foam_oil : drained * s->V1_foam_oil);
    gas = double_max(2, 0.0, s->V1_foam - s->V1_foam_oil);
    gas = (s->V1_foam < 1e-15 ? gas : burst * gas);
    s->V1_foam = double_max(2, 0.0, s->V1_foam - oil - gas);
    s->V1_foam_oil -= oil;
    s->V1_oil += oil;
    s->V1_gas += gas;
    oil = (s->V2_foam < 1e-15 ? s->V2_foam_oil : drained * s->V2_foam_oil);
    gas = double_max(2, 0.0, s->V2_foam - s->V2_foam_oil);
    gas = (s->V2_foam < 1e-15 ? gas : burst * gas);
    s->V2_foam = double_max(2, 0.0, s->V2_foam - oil - gas);
    s->V2_foam_oil -= oil;
    s->V2_oil += oil;
    s->V2_gas += gas;
    /* The reserve's gas is the rest of its volume. */
    oil = (s->V3_foam < 1e-15 ? s->V3_foam_oil : drained * s->V3_foam_oil);
    gas = double_max(2, 0.0, s->V3_foam - s->V3_foam_oil);
    gas = (s->V3_foam < 1e-15 ? gas : burst * gas);
    s->V3_foam = double_max(2, 0.0, s->V3_foam - oil - gas);
    s->V3_foam_oil -= oil;
    s->V3_oil += oil;
}

/* Turn gas back into oil. */
static void kernel_gas_redissolution_phases(struct kernel_Parameters* p, struct kernel_State* s, double way, double dt)
{
    double rate;
    double back;
    double gas;
    double part;
    rate = p->redissolution_rate * (1.0 - p->pressed_share + p->pressed_share * fabs(s->F_fluid) / 1000.0);
    back = s->V_cav * (1.0 - exp((-rate) * dt));
    s->V_cav -= back;
    s->V3_oil += p->reserve_share * back;
    back -= p->reserve_share * back;
    gas = s->V1_gas + s->V2_gas;
    if (gas <= back)
    {
        s->V1_oil += s->V1_gas;
        s->V2_oil += s->V2_gas;
        s->V3_oil += back - gas;
        s->V1_gas = 0.0;
        s->V2_gas = 0.0;
        return;
    }
    part = back / gas;
    s->V1_oil += part * s->V1_gas;
    s->V2_oil += part * s->V2_gas;
    s->V1_gas -= part * s->V1_gas;
    s->V2_gas -= part * s->V2_gas;
}

/* Oil [m3/s] through the cut at a fluid force F [N] in rebound, which the ring of the piston carries. */
static double kernel_cut_flow(struct kernel_Parameters* p, double F)
{
    double ring;
    ring = 0.25 * M_PI * (p->D_li * p->D_li - p->D_PR * p->D_PR);
    return p->cut_area * sqrt(2.0 * F / (870.0 * ring));
}

/* Take the oil for the stroke `way` >= 0 [m]. */
static void kernel_seal_leak_phases(struct kernel_Parameters* p, struct kernel_State* s, double way, double dt)
{
    double left;
    double oil;
    left = p->leak_film * way;
    if ((p->leak_power != 1.0) && (dt > 0.0))
    {
        left = p->leak_film * 0.1 * dt * pow(way / (0.1 * dt), p->leak_power);
    }
    oil = double_min(2, left, s->V3_oil);
    s->V3_oil -= oil;
    s->V_lost += oil;
    left = (left - oil) * p->leak_beyond;
    if (left > 0.0)
    {
        oil = double_min(2, left, s->V2_oil);
        s->V2_oil -= oil;
        s->V2_gas += oil;
        s->V_lost += oil;
        left -= oil;
    }
    if (left > 0.0)
    {
        oil = double_min(2, left, s->V3_foam_oil);
        s->V3_foam_oil -= oil;
        s->V3_foam = (s->V3_foam_oil > 0.0 ? s->V3_foam - oil : 0.0);
        s->V_lost += oil;
        left -= oil;
    }
    if (left > 0.0)
    {
        oil = double_min(2, left, s->V1_oil);
        s->V1_oil -= oil;
        s->V1_gas += oil;
        s->V_lost += oil;
    }
    if ((p->cut_area > 0.0) && (s->F_fluid > 0.0) && (way > 0.0))
    {
        oil = double_min(2, kernel_cut_flow(p, s->F_fluid) * dt, s->V1_oil);
        s->V1_oil -= oil;
        s->V1_gas += oil;
        s->V_lost += oil;
    }
}

/* Cool down over `dt` [s]. */
static void kernel_oil_temperature_phases(struct kernel_Parameters* p, struct kernel_State* s, double way, double dt)
{
    s->heat *= exp((-dt) / p->cooling_time);
}

static void kernel_effects_phases(struct kernel_Parameters* p, struct kernel_State* s, double way, double dt)
{
    if (p->foam_decay_rate != 0.0)
    {
        kernel_foam_decay_phases(p, s, way, dt);
    }
    if (p->redissolution_rate != 0.0)
    {
        kernel_gas_redissolution_phases(p, s, way, dt);
    }
    if ((p->leak_film != 0.0) || (p->cut_area != 0.0))
    {
        kernel_seal_leak_phases(p, s, way, dt);
    }
    if ((p->fade_heat != 0.0) || (p->fade_kelvin != 0.0) || (p->friction_kelvin != 0.0))
    {
        kernel_oil_temperature_phases(p, s, way, dt);
    }
    return;
}

/* Share [1] of a step during which the speed exceeds `threshold`, the speed going from |v0| to |v1| evenly. */
static double kernel_share_above(double v0, double v1, double threshold)
{
    double a;
    double b;
    a = fabs(v0);
    b = fabs(v1);
    if ((a > threshold) && (b > threshold))
    {
        return 1.0;
    }
    if ((a <= threshold) && (b <= threshold))
    {
        return 0.0;
    }
    return (double_max(2, a, b) - threshold) / fabs(a - b);
}

/* The three forces of equation 1 at the state `s`; `F_potential` is the intact fluid force [N] at `v` [m/s]. */
static void kernel_set_forces(struct kernel_Parameters* p, struct kernel_Derived* d, struct kernel_State* s, double F_potential, double v)
{
    /* Eq. 1: F_SA = F_S + F_Fr + F_Fl k_degr; the paper's F_S is a slope; F_0 at stroke 0 is added here */
    s->F_gas = kernel_gas_rise(p, d->F_0, d->c_gas, s->z) - d->F_0;
    s->F_friction = kernel_stribeck(p, v) * s->F_D;
    s->F_fluid = F_potential * s->k_degr;
}

/* Bottom valve: V3 gives the flow `supply` [m2], oil, then foam, then gas, to V2 beside the flows that arrive there. */
static void kernel_refill(struct kernel_Parameters* p, struct kernel_State* s, struct kernel_Flow* f, double foaming, double supply, double oil, double gas, double foam, double foam_oil)
{
    double frothed;
    double drawn;
    f->V3_oil = 0.0;
    f->V3_foam = 0.0;
    f->V3_foam_oil = 0.0;
    if (s->V3_oil > 0.0)
    {
        f->V3_oil = -supply;
        oil += supply;
    }
    else if (s->V3_foam > 0.0)
    {
        f->V3_foam = -supply;
        f->V3_foam_oil = (-supply) * s->V3_foam_oil / s->V3_foam;
        foam += supply;
        foam_oil -= f->V3_foam_oil;
    }
    else if ((foaming > 0.0) && (p->S_BV > 0.0) && ((s->V2_oil > 0.0) || (oil > 0.0)))
    {
        frothed = foaming * p->S_BV * supply;
        drawn = p->S_BVoil * frothed;
        if ((s->V2_oil <= 0.0) && (drawn > oil))
        {
            frothed *= oil / drawn;
            drawn = oil;
        }
        gas += supply - frothed;
        oil -= drawn;
        foam += frothed + drawn;
        foam_oil += drawn;
    }
    else
    {
        /* Eq. 30, 32, 33: the foam takes S of the gas flow and S_oil per volume of that gas from V2's oil */
        /* Eq. 31, 34 */
        gas += supply;
    }
    /* Eq. 7, 9; mixing of foams (Eq. 35) is the sum of the oil they hold */
    f->V2_oil = oil;
    f->V2_gas = gas;
    f->V2_foam = foam;
    f->V2_foam_oil = foam_oil;
}

/* Force of a foam holding the volume `oil` in the volume `foam` [m3], relative to that of oil [1]. */
static double kernel_foam_factor(struct kernel_Parameters* p, double oil, double foam)
{
    /* Eq. 36: B p^E */
    if (p->E == 0.0)
    {
        return p->B;
    }
    if (oil <= 0.0)
    {
        return 0.0;
    }
    return p->B * exp(p->E * log(oil / foam));
}

/* Flows of all phases and k_degr while the phases present in `s` stay the same.
   `foaming` and `cavitating` are the shares [1] of the step above the two threshold velocities. */
static void kernel_rebound(struct kernel_Parameters* p, struct kernel_Derived* d, struct kernel_State* s, struct kernel_Flow* f, double foaming, double cavitating)
{
    double oil;
    double gas;
    double foam;
    double foam_oil;
    /* Piston valve: what leaves V1 over the area A_1 (Eq. 6, 8, 11) */
    oil = 0.0;
    gas = 0.0;
    foam = 0.0;
    foam_oil = 0.0;
    if (s->V1_gas > 0.0)
    {
        if ((s->V1_foam > 0.0) && ((p->foam_leaves_with_gas > 0) || (s->V1_oil <= 0.0)))
        {
            foam = d->W_kPV * d->A_1;
            gas = d->A_1 - foam;
            /* Eq. 39: B p1^E W_kPV/(1 - L_PV), and W_kPV/(1 - L_PV) is X_Re */
            f->k_degr = kernel_foam_factor(p, s->V1_foam_oil, s->V1_foam) * p->X_Re;
        }
        else if (s->V1_oil > 0.0)
        {
            /* Eq. 14: W_kPV is the oil flow relative to the intact one, which is A_1 */
            oil = d->W_kPV * d->A_1;
            gas = d->A_1 - oil;
            /* Eq. 25; to the letter it holds beside foam too, which is foam_leaves_with_gas = 0 */
            f->k_degr = p->X_Re;
        }
        else
        {
            gas = d->A_1;
            /* Eq. 16, 24: only gas, no work at the valve */
            f->k_degr = 0.0;
        }
    }
    else if (s->V1_foam > 0.0)
    {
        foam = d->A_1;
        /* Eq. 37, 38: with oil in V1 or without, the foam leaves first; foam that exists acts below 0.05 m/s as well */
        f->k_degr = kernel_foam_factor(p, s->V1_foam_oil, s->V1_foam);
    }
    else
    {
        oil = d->A_1;
        /* Eq. 17, 23: only oil */
        f->k_degr = 1.0;
    }
    if (foam > 0.0)
    {
        foam_oil = foam * s->V1_foam_oil / s->V1_foam;
    }
    f->V1_oil = -oil;
    f->V1_gas = -gas;
    f->V1_foam = -foam;
    f->V1_foam_oil = -foam_oil;
    /* What arrives in V2: cavitation frees gas from the oil, and foam beside oil separates. */
    f->cavitated = cavitating * d->Y_Re * oil;
    /* Eq. 40 */
    gas += f->cavitated;
    /* Eq. 41; with 14 to the letter k would be 1 - Y while cavitating, here the force falls by what follows from the gas */
    oil -= f->cavitated;
    if ((foam > 0.0) && (p->foam_decays > 0) && (s->V1_oil > 0.0))
    {
        oil += foam_oil;
        gas += foam - foam_oil;
        foam = 0.0;
        foam_oil = 0.0;
    }
    /* Eq. 10, 12: V3 gives the rod's volume */
    kernel_refill(p, s, f, foaming, d->A_rod, oil, gas, foam, foam_oil);
}

/* Share [1] of the time that V1, without gas at the moment, vents gas while V2 is full.
   Cavitation brings gas into V1. Where venting is faster, V1 stays at zero gas and the flow slides between the two
   cases; the share is the one that keeps it there (Filippov's convex combination). With the reading `venting` the cases
   follow each other step by step, as V1 has gas at the start of a step or not, and what a step vents too much is oil. One
   step without venting is followed by as many with it as drive its gas out, whatever their length. */
static double kernel_vented_share(struct kernel_Parameters* p, struct kernel_Derived* d, bool as_foam, double foaming, double cavitating)
{
    double stays;
    double gained;
    double surplus;
    double change;
    int64_t steps;
    if (as_foam || (cavitating <= 0.0))
    {
        return 0.0;
    }
    stays = cavitating * d->Y_Co * (1.0 - p->cavitation_foams * foaming * p->S_PV);
    gained = stays * d->A_1;
    if (gained <= 0.0)
    {
        return 0.0;
    }
    surplus = d->A_rod - d->W_kBV_2 * d->A_2;
    change = stays * (d->A_2 - d->W_kBV_2 * d->A_2) - surplus;
    if (change >= 0.0)
    {
        return 1.0;
    }
    if (p->venting > 0)
    {
        steps = (int64_t)ceil(double_min(2, 1000000000.0, gained / (-change)));
        return steps / (steps + 1.0);
    }
    return gained / (gained - change);
}

/* Flows of all phases and k_degr while the phases present in `s` stay the same.
   `foaming` and `cavitating` are the shares [1] of the step above the two threshold velocities. */
static void kernel_compression(struct kernel_Parameters* p, struct kernel_Derived* d, struct kernel_State* s, struct kernel_Flow* f, double foaming, double cavitating)
{
    bool as_foam;
    double gas;
    double piston;
    double bottom;
    double venting;
    double freed;
    double oil;
    double share;
    double kept;
    double foamable;
    double frothed;
    double drawn;
    /* The liquid that leaves V2 is foam where there is foam, but beside oil and gas the reading says which. */
    as_foam = (s->V2_foam > 0.0) && ((s->V2_gas <= 0.0) || (s->V2_oil <= 0.0) || (p->foam_leaves_with_gas > 0));
    gas = 0.0;
    piston = 0.0;
    /* Eq. 15: W_kBV gives the bottom valve's flow; as in Eq. 27-29 it is counted relative to the flow out of V2. */
    if (s->V2_gas > 0.0)
    {
        bottom = 0.0;
        f->k_degr = 0.0;
        if (as_foam || (s->V2_oil > 0.0))
        {
            bottom = d->W_kBV_1 * d->A_2;
            f->k_degr = p->X_Co1;
        }
        gas = d->A_2 - bottom;
    }
    else
    {
        /* Eq. 19: V1 and V2 without gas, the flows and the force of the intact damper. Eq. 26, a fixed share G_PV of the */
        /* outflow through the piston valve, conflicts with 28 and is not used; in 29 the condition of foam in V2 is dropped. */
        venting = (s->V1_gas > 0.0 ? 1.0 : kernel_vented_share(p, d, as_foam, foaming, cavitating));
        /* While V1 holds gas the flows are those of Eq. 28, 29, and the surplus drives the gas out. */
        bottom = d->A_rod + venting * (d->W_kBV_2 * d->A_2 - d->A_rod);
        piston = d->A_2 - bottom;
        f->k_degr = 1.0 + venting * (d->k_Co2 - 1.0);
        /* Eq. 40, 41 */
    }
    f->V2_gas = -gas;
    f->V2_oil = 0.0;
    f->V2_foam = 0.0;
    f->V2_foam_oil = 0.0;
    f->V3_oil = 0.0;
    f->V3_foam = 0.0;
    f->V3_foam_oil = 0.0;
    f->V1_foam = 0.0;
    f->V1_foam_oil = 0.0;
    f->cavitated = 0.0;
    freed = 0.0;
    oil = 0.0;
    if (as_foam)
    {
        share = s->V2_foam_oil / s->V2_foam;
        f->k_degr *= kernel_foam_factor(p, s->V2_foam_oil, s->V2_foam);
        f->V2_foam = -(bottom + piston);
        f->V2_foam_oil = (-share) * (bottom + piston);
        f->V3_foam = bottom;
        f->V3_foam_oil = share * bottom;
        f->V1_foam = piston;
        f->V1_foam_oil = share * piston;
    }
    else
    {
        f->V2_oil = -(bottom + piston);
        f->V3_oil = bottom;
        freed = cavitating * d->Y_Co * piston;
        oil = piston - freed;
        f->cavitated = freed;
    }
    /* V1 takes A_1; what is more leaves it as gas through the rod guide (Eq. 8, 13). */
    kept = d->A_1 + freed - piston;
    if ((s->V1_gas <= 0.0) && (kept < 0.0))
    {
        if (p->venting > 0)
        {
            oil += kept;
            f->V3_oil -= kept;
        }
        kept = 0.0;
    }
    foamable = gas + p->cavitation_foams * freed;
    if ((foaming > 0.0) && (p->S_PV > 0.0) && (foamable > 0.0) && ((s->V1_oil > 0.0) || (oil > 0.0)))
    {
        frothed = foaming * p->S_PV * foamable;
        if ((s->V1_gas <= 0.0) && (frothed > kept))
        {
            frothed = kept;
        }
        drawn = p->S_PVoil * frothed;
        if ((s->V1_oil <= 0.0) && (drawn > oil))
        {
            frothed *= oil / drawn;
            drawn = oil;
        }
        oil -= drawn;
        kept -= frothed;
        f->V1_foam += frothed + drawn;
        f->V1_foam_oil += drawn;
    }
    f->V1_oil = oil;
    f->V1_gas = kept;
}

/* Flows and k_degr in the direction of `dz`; `foaming` and `cavitating` are the shares [1] of the step with either. */
static void kernel_flows(struct kernel_Parameters* p, struct kernel_Derived* d, struct kernel_State* s, struct kernel_Flow* f, double dz, double foaming, double cavitating)
{
    if (dz > 0.0)
    {
        kernel_rebound(p, d, s, f, foaming, cavitating);
    }
    else
    {
        kernel_compression(p, d, s, f, foaming, cavitating);
    }
}

/* k_degr for the direction of `v` [m/s] where the last stroke went the other way or nowhere. */
static void kernel_settle(struct kernel_Parameters* p, struct kernel_Derived* d, struct kernel_State* s, struct kernel_Flow* f, double v)
{
    if (v != 0.0)
    {
        kernel_flows(p, d, s, f, v, kernel_share_above(v, v, p->v_foam), kernel_share_above(v, v, p->v_cav));
        s->k_degr = f->k_degr;
    }
}

/* Foam that does not fit into the reserve loses its gas; the paper has no limit there. */
static void kernel_squeeze_reserve(struct kernel_Derived* d, struct kernel_State* s)
{
    double room;
    room = d->V_reserve - s->V3_oil;
    if (s->V3_foam > room)
    {
        s->V3_foam = double_max(2, room, s->V3_foam_oil);
    }
}

/* End a step at the stroke `z` [m], in which k_degr has the integral `acting` [m] over the stroke. */
static void kernel_arrive(struct kernel_Parameters* p, struct kernel_Derived* d, struct kernel_State* s, struct kernel_Flow* f, double z, double v0, double v1, double acting)
{
    double dz;
    double F_1;
    double F_0;
    bool rising;
    double friction;
    dz = z - s->z;
    F_1 = kernel_fluid_force(p, v1);
    if (dz == 0.0)
    {
        kernel_settle(p, d, s, f, v1);
        f->k_mean = s->k_degr;
        kernel_set_forces(p, d, s, F_1, v1);
        return;
    }
    F_0 = (v0 == v1 ? F_1 : kernel_fluid_force(p, v0));
    rising = dz > 0.0;
    if (!rising)
    {
        kernel_squeeze_reserve(d, s);
    }
    s->z = z;
    s->F_D = kernel_dahl(p, d, s->F_D, dz);
    /* The mean over the step: force times stroke is then the work, wherever in the step a phase ran out. */
    s->k_degr = acting / fabs(dz);
    f->k_mean = s->k_degr;
    if (v1 < 0.0 == rising)
    {
        kernel_settle(p, d, s, f, v1);
    }
    friction = s->F_friction;
    kernel_set_forces(p, d, s, F_1, v1);
    s->work += 0.5 * (F_0 + F_1) * ((rising ? acting : -acting)) + 0.5 * (friction + s->F_friction) * dz;
}

/* Give the share of the oil that gives way to gas to the reserve. */
static void kernel_oil_displacement_flows(struct kernel_Parameters* p, struct kernel_Derived* d, struct kernel_State* s, struct kernel_Flow* f, double dz, double foaming)
{
    double freed;
    double displaced;
    double oil;
    double gas;
    double supply;
    freed = f->cavitated;
    if (freed <= 0.0)
    {
        return;
    }
    displaced = p->displaced_share * freed;
    f->cavitated = freed - displaced;
    if (dz < 0.0)
    {
        f->V3_oil += displaced;
        return;
    }
    /* Where gas is freed V1 gives oil and no foam. */
    oil = (-f->V1_oil) - f->cavitated;
    gas = (-f->V1_gas) + freed;
    supply = d->A_rod - displaced;
    kernel_refill(p, s, f, foaming, double_max(2, 0.0, supply), oil + double_min(2, 0.0, supply), gas, 0.0, 0.0);
    if (supply < 0.0)
    {
        f->V3_oil = -supply;
    }
}

static void kernel_effects_flows(struct kernel_Parameters* p, struct kernel_Derived* d, struct kernel_State* s, struct kernel_Flow* f, double dz, double foaming)
{
    if (p->displaced_share != 0.0)
    {
        kernel_oil_displacement_flows(p, d, s, f, dz, foaming);
    }
    return;
}

/* The stroke [m], at most `way`, after which a phase of `volume` [m3] changing by `change` [m2] is used up. */
static double kernel_before_empty(double volume, double change, double way)
{
    if ((change < 0.0) && (volume + change * way < 0.0))
    {
        return volume / (-change);
    }
    return way;
}

/* The part [m] of the stroke `way` over which every phase lasts. */
static double kernel_split_length(struct kernel_State* s, struct kernel_Flow* f, double way)
{
    way = kernel_before_empty(s->V1_oil, f->V1_oil, way);
    way = kernel_before_empty(s->V1_gas, f->V1_gas, way);
    way = kernel_before_empty(s->V1_foam, f->V1_foam, way);
    way = kernel_before_empty(s->V2_oil, f->V2_oil, way);
    way = kernel_before_empty(s->V2_gas, f->V2_gas, way);
    way = kernel_before_empty(s->V2_foam, f->V2_foam, way);
    way = kernel_before_empty(s->V3_oil, f->V3_oil, way);
    return kernel_before_empty(s->V3_foam, f->V3_foam, way);
}

/* A phase's volume [m3] after the stroke `way` [m]; what runs out is exactly zero. */
static double kernel_moved(double volume, double change, double way)
{
    double after;
    after = volume + change * way;
    /* Rounding leaves a trace of 1e-16 of the volume where the split was made. */
    if ((change < 0.0) && (after < 1e-15 * volume))
    {
        return 0.0;
    }
    return after;
}

/* Carry all phases over the stroke `way` [m] (Eq. 4, 5: the sums of the phases stay the chamber volumes). */
static void kernel_move(struct kernel_State* s, struct kernel_Flow* f, double way)
{
    s->V1_oil = kernel_moved(s->V1_oil, f->V1_oil, way);
    s->V1_gas = kernel_moved(s->V1_gas, f->V1_gas, way);
    s->V1_foam = kernel_moved(s->V1_foam, f->V1_foam, way);
    s->V2_oil = kernel_moved(s->V2_oil, f->V2_oil, way);
    s->V2_gas = kernel_moved(s->V2_gas, f->V2_gas, way);
    s->V2_foam = kernel_moved(s->V2_foam, f->V2_foam, way);
    s->V3_oil = kernel_moved(s->V3_oil, f->V3_oil, way);
    s->V3_foam = kernel_moved(s->V3_foam, f->V3_foam, way);
    /* Eq. 35 */
    s->V1_foam_oil = (s->V1_foam > 0.0 ? kernel_moved(s->V1_foam_oil, f->V1_foam_oil, way) : 0.0);
    s->V2_foam_oil = (s->V2_foam > 0.0 ? kernel_moved(s->V2_foam_oil, f->V2_foam_oil, way) : 0.0);
    s->V3_foam_oil = (s->V3_foam > 0.0 ? kernel_moved(s->V3_foam_oil, f->V3_foam_oil, way) : 0.0);
    s->V_cav += f->cavitated * way;
}

/* Carry all phases as far as each of them lasts, at most over the stroke `left` [m]; returns the stroke [m]. */
static double kernel_carry(struct kernel_State* s, struct kernel_Flow* f, double left)
{
    double way;
    way = kernel_split_length(s, f, left);
    kernel_move(s, f, way);
    return way;
}

/* `kernel.step` with flows that effects change. */
static bool kernel_changed_step(struct kernel_Parameters* p, struct kernel_Derived* d, struct kernel_State* s, struct kernel_Flow* f, double z, double v0, double v1)
{
    double dz;
    double left;
    double foaming;
    double cavitating;
    double acting;
    int64_t splits;
    double way;
    dz = z - s->z;
    left = fabs(dz);
    foaming = kernel_share_above(v0, v1, p->v_foam);
    cavitating = kernel_share_above(v0, v1, p->v_cav);
    acting = 0.0;
    splits = 0;
    while((left > 0.0) && (splits < 64))
    {
        kernel_flows(p, d, s, f, dz, foaming, cavitating);
        kernel_effects_flows(p, d, s, f, dz, foaming);
        way = kernel_carry(s, f, left);
        acting += f->k_degr * way;
        left -= way;
        splits += 1;
    }
    kernel_arrive(p, d, s, f, z, v0, v1, acting);
    return left <= 0.0;
}

/* Integral from 0 to `y` of the share of the force [1] that closing valves let build up. */
static double kernel_fluid_lag_shut(double y)
{
    double left;
    left = double_max(2, 0.0, 1.0 - y);
    return y - (1.0 - left * left * left) / 3.0;
}

/* While the check valves close a share of the force is there, in the mean over the step and at its end. */
static void kernel_fluid_lag_transition(struct kernel_Parameters* p, struct kernel_State* s, struct kernel_Flow* f, double v, double dz)
{
    double v0;
    double way;
    double begun;
    double side;
    bool turned;
    double ended;
    double left;
    if (p->closing_stroke <= 0.0)
    {
        return;
    }
    v0 = s->goal_v0;
    way = fabs(dz) / p->closing_stroke;
    begun = s->closed;
    side = (v > 0.0 ? 1.0 : ((v < 0.0 ? -1.0 : s->closing_side)));
    turned = v0 * v < 0.0;
    if ((side * s->closing_side < 0.0) && (!(turned && (dz * side < 0.0))))
    {
        begun = 0.0;
    }
    ended = begun + way;
    if (way > 0.0)
    {
        f->k_mean *= (kernel_fluid_lag_shut(ended) - kernel_fluid_lag_shut(begun)) / way;
    }
    if (turned)
    {
        ended = 0.5 * v * v * s->duration / (fabs(v0) + fabs(v)) / p->closing_stroke;
    }
    s->closing_side = side;
    s->closed = double_min(2, 1.0, ended);
    left = 1.0 - s->closed;
    f->k_degr *= 1.0 - left * left;
    s->k_degr *= 1.0 - left * left;
}

/* Stroke [m] in which a `volume` [m3] leaves with a `flow` [m2]. */
static double kernel_smooth_transition_stroke(double volume, double flow)
{
    return (volume <= 0.0 ? 0.0 : ((flow > 0.0 ? double_min(2, 1000.0, volume / flow) : 1000.0)));
}

/* The strokes until gas and foam run out. */
static void kernel_smooth_transition_look(struct kernel_State* s, struct kernel_Flow* f, double side)
{
    s->foam_ahead = 0.0;
    s->vent_ahead = 0.0;
    if (side > 0.0)
    {
        s->gas_ahead = kernel_smooth_transition_stroke(s->V1_gas, -f->V1_gas);
        if (s->V1_foam > 0.0)
        {
            s->foam_ahead = kernel_smooth_transition_stroke(s->V1_gas + s->V1_foam, -(f->V1_gas + f->V1_foam + f->V1_oil));
        }
    }
    else
    {
        s->gas_ahead = kernel_smooth_transition_stroke(s->V2_gas, -f->V2_gas);
        if (s->V2_foam > 0.0)
        {
            s->foam_ahead = kernel_smooth_transition_stroke(s->V2_gas + s->V2_foam, -(f->V2_gas + f->V2_foam + f->V2_oil));
        }
        if (s->V2_gas <= 0.0)
        {
            s->vent_ahead = kernel_smooth_transition_stroke(s->V1_gas, -f->V1_gas);
        }
    }
}

/* Share [1] of a step that has come at a stroke `ahead` [m] of it. */
static double kernel_smooth_transition_early(struct kernel_Parameters* p, double ahead, double length)
{
    double near;
    near = double_max(2, 0.0, 1.0 - 0.5 * ahead / length);
    return (ahead > 0.0 ? p->early_share * near * near : 0.0);
}

/* What has already come [1] of the steps ahead of `k`. */
static double kernel_smooth_transition_coming(struct kernel_Parameters* p, struct kernel_State* s, double side, double k, double length)
{
    double gas;
    double foam;
    double coming;
    gas = (side > 0.0 ? s->rise_gas_re : s->rise_gas_co);
    foam = (side > 0.0 ? s->rise_foam_re : s->rise_foam_co);
    coming = gas * kernel_smooth_transition_early(p, s->gas_ahead, length) + foam * kernel_smooth_transition_early(p, s->foam_ahead, length);
    coming += s->rise_vent * kernel_smooth_transition_early(p, s->vent_ahead, length);
    return double_max(2, 0.0, double_min(2, 1.0 - k, coming));
}

/* Begin a direction at its own value `k`. */
static void kernel_smooth_transition_turn(struct kernel_Parameters* p, struct kernel_State* s, struct kernel_Flow* f, double side, double k)
{
    double ended;
    if (s->k_side > 0.0)
    {
        s->k_end_re = s->k_last;
    }
    else if (s->k_side < 0.0)
    {
        s->k_end_co = s->k_last;
    }
    ended = (side > 0.0 ? s->k_end_re : s->k_end_co);
    s->k_carried = (ended >= 0.0 ? p->carry_turn * (ended - k) : 0.0);
    s->k_side = side;
    s->k_target = k;
    s->since_turn = 0.0;
    kernel_smooth_transition_look(s, f, side);
}

/* The `rise` [1] of k_degr in a step in which `gas` or `foam` or the gas of V1 has run out. */
static void kernel_smooth_transition_remember(struct kernel_State* s, double side, bool gas, bool foam, bool vent, double rise)
{
    double alone;
    if (gas)
    {
        if (side > 0.0)
        {
            s->rise_gas_re = rise;
        }
        else
        {
            s->rise_gas_co = rise;
        }
    }
    if (foam)
    {
        /* What runs out in one step is one step of the force. */
        alone = (gas ? 0.0 : rise);
        if (side > 0.0)
        {
            s->rise_foam_re = alone;
        }
        else
        {
            s->rise_foam_co = alone;
        }
    }
    if (vent)
    {
        s->rise_vent = (foam ? 0.0 : rise);
    }
}

/* Mean of exp(-y) [1] over 0 <= y <= `way`. */
static double kernel_smooth_transition_fade(double way)
{
    return (way > 1e-09 ? (1.0 - exp(-way)) / way : 1.0);
}

/* Change the mean over the step, `f.k_mean`, and the value at its end. */
static void kernel_smooth_transition_transition(struct kernel_Parameters* p, struct kernel_State* s, struct kernel_Flow* f, double v, double dz)
{
    double settled;
    double side;
    double length;
    bool gas;
    bool foam;
    bool vent;
    double known;
    double mean;
    double end;
    double rise;
    double gained;
    double carried;
    double target;
    double way;
    double layer;
    double late;
    double coming;
    double turned;
    settled = s->k_degr;
    side = (dz > 0.0 ? 1.0 : ((dz < 0.0 ? -1.0 : s->k_side)));
    if (side != s->k_side)
    {
        kernel_smooth_transition_turn(p, s, f, side, f->k_mean);
    }
    length = double_max(2, 1e-09, p->build_up + 0.5 * p->tau_build * (fabs(s->goal_v0) + fabs(s->goal_v1)));
    gas = s->gas_ahead > 0.0;
    foam = s->foam_ahead > 0.0;
    vent = s->vent_ahead > 0.0;
    kernel_smooth_transition_look(s, f, side);
    known = s->k_target;
    mean = ((dz != 0.0) || (side == 0.0) ? f->k_mean : known);
    end = ((dz != 0.0) || (side == 0.0) ? f->k_degr : known);
    rise = 0.0;
    gained = 0.0;
    if (dz != 0.0)
    {
        gas = gas && (s->gas_ahead == 0.0);
        foam = foam && (s->foam_ahead == 0.0);
        vent = vent && (s->vent_ahead == 0.0);
        if (gas || foam || vent)
        {
            rise = double_max(2, 0.0, end - known);
            kernel_smooth_transition_remember(s, side, gas, foam, vent, rise);
        }
    }
    carried = s->k_carried;
    target = mean;
    if (rise > 0.0)
    {
        gained = double_max(2, 0.0, double_min(2, 1.0, (mean - known) / rise));
        mean += p->early_share * rise * (1.0 - gained);
        target = end;
    }
    else
    {
        /* In the step in which something runs out the kernel's mean tells where. */
        carried += p->carry_over * (known - target);
    }
    way = fabs(dz) / length;
    layer = s->since_turn + (1.0 - gained) * fabs(dz);
    late = (1.0 - p->early_share) * rise * (1.0 - (1.0 - p->carry_turn) * exp((-layer) / (0.1 * length)));
    s->since_turn += fabs(dz);
    /* What is left of the past is at most the intact damper's: else every return of the gas would add another step to it. */
    carried = double_min(2, carried, 1.0 - target + late);
    coming = kernel_smooth_transition_coming(p, s, side, end, length);
    mean += coming + carried * kernel_smooth_transition_fade(way) - late * gained * kernel_smooth_transition_fade(gained * way);
    f->k_mean = double_max(2, 0.0, double_min(2, 1.0, mean));
    s->k_carried = carried * exp(-way) - late * exp((-gained) * way);
    s->k_target = target;
    f->k_degr = double_max(2, 0.0, double_min(2, 1.0, end + coming + s->k_carried));
    s->k_last = f->k_degr;
    s->k_degr = (dz != 0.0 ? f->k_mean : f->k_degr);
    turned = (v > 0.0 ? 1.0 : ((v < 0.0 ? -1.0 : s->k_side)));
    if (turned != s->k_side)
    {
        /* The kernel has settled k_degr for the new direction, the mean over the step belongs to the one before. */
        s->k_last = (dz != 0.0 ? f->k_mean : s->k_last);
        kernel_smooth_transition_turn(p, s, f, turned, settled);
        s->k_degr = settled + s->k_carried;
        f->k_degr = s->k_degr;
    }
}

static void kernel_effects_transition(struct kernel_Parameters* p, struct kernel_State* s, struct kernel_Flow* f, double v, double dz)
{
    if ((p->C_fluid != 0.0) || (p->C_fluid_co != 0.0) || (p->V_air != 0.0) || (p->tau_fluid != 0.0) || (p->closing_stroke != 0.0))
    {
        kernel_fluid_lag_transition(p, s, f, v, dz);
    }
    if ((p->build_up != 0.0) || (p->tau_build != 0.0))
    {
        kernel_smooth_transition_transition(p, s, f, v, dz);
    }
    return;
}

/* Share of the fluid force that is left [1]. */
static double kernel_oil_temperature_scale_fluid(struct kernel_Parameters* p, struct kernel_State* s, double v)
{
    double kelvin;
    double thin;
    double laminar;
    kelvin = s->warm + p->H_start / 700.0;
    thin = exp(double_min(2, 2.0, (-p->fade_heat) * (p->H_start + s->heat) - p->fade_kelvin * kelvin));
    laminar = 1.0 / (1.0 + p->turbulence * fabs(v));
    return laminar * thin + (1.0 - laminar) * pow(thin, p->thin_density);
}

/* Factor [1] of the force `F` [N] at the speed `u` >= 0 [m/s] where the open blow-off has `lost` force [N]. */
static double kernel_valve_wear_opening(struct kernel_Parameters* p, double u, double lost, double F)
{
    double opened;
    opened = double_min(2, 1.0, double_max(2, 0.0, u / p->opening_speed - 0.5));
    return ((opened > 0.0) && (F > 0.0) ? double_max(2, 0.0, 1.0 - opened * lost / F) : 1.0);
}

/* Factor of the fluid force [1] in the direction of `v`. */
static double kernel_valve_wear_scale_fluid(struct kernel_Parameters* p, struct kernel_State* s, double v)
{
    double opened;
    if (v >= 0.0)
    {
        opened = (p->opening_re > 0.0 ? kernel_valve_wear_opening(p, v, p->opening_re, kernel_branch(v, p->v_re, p->F_re)) : 1.0);
        return (1.0 + p->wear_re) * opened;
    }
    opened = (p->opening_co > 0.0 ? kernel_valve_wear_opening(p, -v, p->opening_co, kernel_branch(-v, p->v_co, p->F_co)) : 1.0);
    return (1.0 + p->wear_co) * opened;
}

static double kernel_effects_scale_fluid(struct kernel_Parameters* p, struct kernel_State* s, double v)
{
    double value;
    value = 1.0;
    if ((p->fade_heat != 0.0) || (p->fade_kelvin != 0.0) || (p->friction_kelvin != 0.0))
    {
        value *= kernel_oil_temperature_scale_fluid(p, s, v);
    }
    if ((p->wear_re != 0.0) || (p->wear_co != 0.0) || (p->bleed_re != 0.0) || (p->bleed_co != 0.0) || (p->opening_re != 0.0) || (p->opening_co != 0.0))
    {
        value *= kernel_valve_wear_scale_fluid(p, s, v);
    }
    return value;
}

/* Where k_degr has stepped, balance the part of the step after it again: deflection and piston's speed at its end. */
static void kernel_mount_compliance_rebalance(struct kernel_Parameters* p, struct kernel_Derived* d, struct kernel_State* s, double v, double dt)
{
    double k_used;
    double k;
    double after;
    s->F_even = 0.5 * (s->F_before + s->F_mount);
    k_used = (s->u_valve >= 0.0 ? s->k_used_re : s->k_used_co);
    k = (s->u_valve >= 0.0 ? s->k_re : s->k_co);
    if ((dt > 0.0) && (k != k_used))
    {
        /* The kernel's mean over the step tells where. */
        after = double_max(2, 0.0, double_min(2, 1.0, (s->k_degr - k_used) / (k - k_used)));
        s->x_begun = s->x_mount - after * dt * (v - s->goal_v1);
        s->end_share = after;
        kernel_mount_compliance_solve(p, d, s, v, dt);
        s->F_even += after * (s->F_mount - s->F_even);
    }
}

static void kernel_effects_rebalance(struct kernel_Parameters* p, struct kernel_Derived* d, struct kernel_State* s, double v, double dt)
{
    if (p->C_mount != 0.0)
    {
        kernel_mount_compliance_rebalance(p, d, s, v, dt);
    }
    return;
}

/* Speed [m/s] at which the valves of one branch make the force `F` >= 0 [N], and the slope there [N s/m]. */
static int64_t kernel_valve_speed(double* result_0_0001, double* result_1, double F, double k, array_double_1d velocities, array_double_1d forces)
{
    int64_t i;
    double slope;
    if (k < 1e-12)
    {
        (*result_0_0001) = 0.0;
        (*result_1) = 0.0;
        return 0;
    }
    i = 0;
    while((i < 20 - 1) && (k * (*cspan_at(&forces, i)) < F))
    {
        i += 1;
    }
    if (i == 0)
    {
        slope = k * (*cspan_at(&forces, 0)) / (*cspan_at(&velocities, 0));
        (*result_0_0001) = (slope > 0.0 ? F / slope : 0.0);
        (*result_1) = slope;
        return 0;
    }
    slope = k * ((*cspan_at(&forces, i)) - (*cspan_at(&forces, i - 1))) / ((*cspan_at(&velocities, i)) - (*cspan_at(&velocities, i - 1)));
    (*result_0_0001) = (*cspan_at(&velocities, i - 1)) + ((slope > 0.0 ? (F - k * (*cspan_at(&forces, i - 1))) / slope : 0.0));
    (*result_1) = slope;
    return 0;
}

/* Speed [m/s] in the direction of the force `F` [N] that passes beside the valves. */
static double kernel_valve_wear_bypass(struct kernel_Parameters* p, double F)
{
    if (F >= 0.0)
    {
        return kernel_valve_wear_leak(p, p->bleed_re, F);
    }
    return -kernel_valve_wear_leak(p, p->bleed_co, -F);
}

static double kernel_effects_bypass(struct kernel_Parameters* p, double F)
{
    double value;
    value = 0.0;
    if ((p->wear_re != 0.0) || (p->wear_co != 0.0) || (p->bleed_re != 0.0) || (p->bleed_co != 0.0) || (p->opening_re != 0.0) || (p->opening_co != 0.0))
    {
        value += kernel_valve_wear_bypass(p, F);
    }
    return value;
}

/* As `valve_speed`, with what passes beside the valves. */
static int64_t kernel_side_valves(double* result_0, double* result_1, struct kernel_Parameters* p, double side, double k, double F)
{
    double u;
    double slope;
    if (side > 0.0)
    {
        kernel_valve_speed(&u, &slope, F, k, p->v_re, p->F_re);
    }
    else
    {
        kernel_valve_speed(&u, &slope, F, k, p->v_co, p->F_co);
    }
    if (k >= 1e-12)
    {
        u += side * kernel_effects_bypass(p, side * F / k);
    }
    (*result_0) = u;
    (*result_1) = slope;
    return 0;
}

/* The speed u >= 0 [m/s] at the valves of one branch of the F-v curve with u + given(F(u)) / dt = w >= 0.
   `C`, `way` and `F_half` are those of `column_of`, `k` the degradation of the branch. */
static double kernel_column_speed(double C, double way, double F_half, double w, double k, array_double_1d velocities, array_double_1d forces, double dt)
{
    int64_t i;
    double u;
    double F;
    double slope;
    double rest;
    double a;
    double b;
    double c;
    double root;
    double found;
    i = 0;
    while((i < 20 - 1) && ((*cspan_at(&velocities, i)) + (C + way / (k * (*cspan_at(&forces, i)) + F_half)) * k * (*cspan_at(&forces, i)) / dt < w))
    {
        i += 1;
    }
    u = 0.0;
    F = 0.0;
    if (i > 0)
    {
        u = (*cspan_at(&velocities, i - 1));
        F = k * (*cspan_at(&forces, i - 1));
    }
    slope = (k * (*cspan_at(&forces, i)) - F) / ((*cspan_at(&velocities, i)) - u);
    /* F = F_i + slope (u' - u_i) put into the equation makes a F^2 + b F - c = 0, of which one root is not negative. */
    rest = F + slope * (w - u);
    a = 1.0 + slope * C / dt;
    b = a * F_half + slope * way / dt - rest;
    c = double_max(2, 0.0, rest * F_half);
    root = sqrt(b * b + 4.0 * a * c);
    found = (b > 0.0 ? 2.0 * c / (b + root) : (root - b) / (2.0 * a));
    return double_max(2, 0.0, w - (C + way / (found + F_half)) * found / dt);
}

/* As `column_speed` with the F-v curve of the side. */
static double kernel_side_speed(struct kernel_Parameters* p, double side, double C, double way, double F_half, double w, double k, double dt)
{
    double result;
    if (side > 0.0)
    {
        result = kernel_column_speed(C, way, F_half, w, k, p->v_re, p->F_re, dt);
        return result;
    }
    result = kernel_column_speed(C, way, F_half, w, k, p->v_co, p->F_co, dt);
    return result;
}

/* Force [N] of the intact valves at the speed `u` >= 0 [m/s]. */
static double kernel_side_force(struct kernel_Parameters* p, double side, double u)
{
    return side * kernel_fluid_force(p, side * u);
}

/* As `side_speed`, with what passes beside the valves: secants for its speed between bounds that close in. */
static double kernel_leaking_speed(struct kernel_Parameters* p, double side, double C, double way, double F_half, double w, double k, double dt)
{
    double low;
    double high;
    double r_low;
    double past;
    double r_high;
    int64_t n;
    double r;
    double u;
    u = kernel_side_speed(p, side, C, way, F_half, w, k, dt);
    low = 0.0;
    high = side * kernel_effects_bypass(p, side * kernel_side_force(p, side, u));
    if (high <= 0.0)
    {
        return u;
    }
    /* The faster the leak, the less force is left that drives it: `past` less what that force makes of it rises. */
    r_low = -high;
    past = double_min(2, high, w);
    u = kernel_side_speed(p, side, C, way, F_half, w - past, k, dt);
    r_high = past - side * kernel_effects_bypass(p, side * kernel_side_force(p, side, u));
    high = past;
    n = 0;
    while((n < 40) && (high - low > 1e-09))
    {
        past = double_min(2, double_max(2, low - r_low * (high - low) / (r_high - r_low), low + 0.05 * (high - low)), high - 0.05 * (high - low));
        u = kernel_side_speed(p, side, C, way, F_half, w - past, k, dt);
        r = past - side * kernel_effects_bypass(p, side * kernel_side_force(p, side, u));
        if (r < 0.0)
        {
            low = past;
            r_low = r;
        }
        else
        {
            high = past;
            r_high = r;
        }
        n += 1;
    }
    return u;
}

/* Elastic energy [J] of a column under the force `F` >= 0 [N]. */
static double kernel_column_energy(double C, double way, double F_half, double F)
{
    return 0.5 * C * F * F + way * F_half * (log(1.0 + F / F_half) - F / (F + F_half));
}

/* Carry one column over a part of a step: its force at the end, and its part of `F_mean` and `W_step` of the state.
   The part takes `dt` [s] and ends at the stroke `z` [m] after a way of `dz` [m]; `v0` and `v1` [m/s] are the speeds in the
   column's direction, `k` [1] the degradation of its branch. A column without force is pressed in the share `free` [1] of
   the part. Returns that share for the other column. */
static double kernel_column_press(struct kernel_Parameters* p, struct kernel_State* s, double side, double k, double free, double v0, double v1, double z, double dz, double dt)
{
    double held;
    double turn;
    double begun;
    double pressed;
    double C;
    double way;
    double F_half;
    double u;
    double slope;
    double given;
    double before;
    double share;
    double F;
    int64_t n;
    double settling;
    double w;
    double end;
    double after;
    double travelled;
    double through;
    double even;
    double stiff;
    double mean;
    double shorter;
    double bound;
    held = (side > 0.0 ? s->F_held_re : s->F_held_co);
    turn = (side > 0.0 ? s->F_turn_re : s->F_turn_co);
    begun = v0;
    pressed = dt;
    if (held <= 0.0)
    {
        if (v0 < 0.0)
        {
            /* The column is pressed from the reversal on. */
            begun = 0.0;
            pressed = (v1 > 0.0 ? dt * v1 / (v1 - v0) : 0.0);
        }
        begun = v1 - free * (v1 - begun);
        pressed *= free;
    }
    if (pressed < 1e-12)
    {
        return 1.0;
    }
    kernel_column_of(&C, &way, &F_half, p, side, z);
    kernel_side_valves(&u, &slope, p, side, k, held);
    given = C + way * F_half / ((held + F_half) * (held + F_half));
    before = kernel_column_stroke(C, way, F_half, held);
    share = 1.0;
    F = 0.0;
    n = 0;
    /* Trapped air gets stiff while it is pressed: again with its mean compliance. */
    while(n < ((way > 0.0 ? 2 : 1)))
    {
        settling = given * slope;
        share = (settling > 0.0 ? kernel_end_weight(pressed / settling) : 1.0);
        w = v1 + (before / pressed + (1.0 - share) * (begun - u)) / share;
        end = (w > 0.0 ? kernel_leaking_speed(p, side, C, way, F_half, w, k, share * pressed) : 0.0);
        F = k * kernel_side_force(p, side, end);
        given = C + way * F_half / ((held + F_half) * (F + F_half));
        n += 1;
    }
    after = kernel_column_stroke(C, way, F_half, F);
    travelled = 0.5 * (begun + v1) * pressed;
    through = double_max(2, 0.0, travelled + before - after) / dt;
    /* A stiff column lets the steps of k_degr through, a soft one does not. */
    even = 0.5 * (held + F) * pressed / dt;
    stiff = k * kernel_side_force(p, side, through) * kernel_effects_scale_valve(p, side * through);
    mean = even + (2.0 * share - 1.0) * (stiff - even);
    s->F_mean += side * mean;
    s->W_step += mean * through * dt;
    if ((held > 0.0) && (p->column_share > 0.0))
    {
        shorter = kernel_column_length(p, side, z - dz) / kernel_column_length(p, side, z) - 1.0;
        s->W_step += shorter * kernel_column_energy(C, way, F_half, held);
    }
    if (side > 0.0)
    {
        s->F_held_re = F;
    }
    else
    {
        s->F_held_co = F;
    }
    if (v1 >= 0.0)
    {
        if (side > 0.0)
        {
            s->F_turn_re = F;
        }
        else
        {
            s->F_turn_co = F;
        }
    }
    bound = (1.0 - p->relief_first) * turn;
    if (held <= bound)
    {
        return 1.0;
    }
    bound = kernel_column_stroke(C, way, F_half, bound);
    if (F <= 0.0)
    {
        after = double_min(2, 0.0, before + travelled);
    }
    return (before > after ? double_min(2, 1.0, double_max(2, 0.0, (bound - after) / (before - after))) : 0.0);
}

/* Carry the columns and the late valves over a part of a step, as `column_press`, speeds with their sign.
   `F_mean` and `W_step` of the state are those of the part then. */
static void kernel_fluid_lag_part(struct kernel_Parameters* p, struct kernel_State* s, double k_re, double k_co, double v0, double v1, double z, double dz, double dt)
{
    double free;
    double Dummy_0000;
    double Dummy_0001;
    double mean;
    double late;
    s->F_mean = 0.0;
    s->W_step = 0.0;
    /* The column that the piston leaves comes first. */
    if (v1 >= 0.0)
    {
        free = kernel_column_press(p, s, -1.0, k_co, 1.0, -v0, -v1, z, dz, dt);
        Dummy_0000 = kernel_column_press(p, s, 1.0, k_re, free, v0, v1, z, dz, dt);
    }
    else
    {
        free = kernel_column_press(p, s, 1.0, k_re, 1.0, v0, v1, z, dz, dt);
        Dummy_0001 = kernel_column_press(p, s, -1.0, k_co, free, -v0, -v1, z, dz, dt);
    }
    s->F_fluid = s->F_held_re - s->F_held_co;
    s->F_valve = s->F_fluid;
    if (p->tau_fluid > 0.0)
    {
        /* The columns' force goes evenly, with this mean, to its end. */
        mean = s->F_mean;
        late = 2.0 * (s->F_fluid - mean) * p->tau_fluid / dt;
        s->F_fluid = s->F_fluid - late + (s->F_late - 2.0 * mean + s->F_fluid + late) * exp((-dt) / p->tau_fluid);
        s->F_mean += (s->F_late - s->F_fluid) * p->tau_fluid / dt;
        s->W_step += (s->F_mean - mean) * dz;
        s->F_late = s->F_fluid;
    }
}

/* The fluid force with the memory of the oil columns; a step without time leaves it, but for the first. */
static void kernel_fluid_lag_force(struct kernel_Parameters* p, struct kernel_State* s, double v, double dz, double dt)
{
    double k_re;
    double k_co;
    double v0;
    double v1;
    double after;
    double v_jump;
    double later;
    double k_begun_re;
    double k_begun_co;
    double mean;
    double work;
    int64_t parts;
    double begun;
    int64_t i;
    double ended;
    double way;
    double at;
    if (dt <= 0.0)
    {
        if (s->elapsed > 0.0)
        {
            s->F_valve = s->F_held_re - s->F_held_co;
            s->F_fluid = (p->tau_fluid > 0.0 ? s->F_late : s->F_valve);
            s->F_mean = s->F_fluid;
            /* The columns' work goes by the time: that of a way without time is in the steps around it. */
            s->W_step = 0.0;
        }
        return;
    }
    k_re = (dz > 0.0 ? s->k_mean : s->k_re);
    k_co = (dz < 0.0 ? s->k_mean : s->k_co);
    v0 = s->goal_v0;
    v1 = s->goal_v1;
    /* In a step of a single direction the mean of k_degr tells when it jumped from its last value to that of the end. */
    after = 0.0;
    if ((dz > 0.0) && (v0 > 0.0) && (v1 > 0.0) && (s->k_re != s->k_held_re))
    {
        after = (k_re - s->k_held_re) / (s->k_re - s->k_held_re);
    }
    else if ((dz < 0.0) && (v0 < 0.0) && (v1 < 0.0) && (s->k_co != s->k_held_co))
    {
        after = (k_co - s->k_held_co) / (s->k_co - s->k_held_co);
    }
    if ((after <= 0.0) || (after >= 1.0))
    {
        kernel_fluid_lag_part(p, s, k_re, k_co, v0, v1, s->z, dz, dt);
        return;
    }
    v_jump = v1 + after * (v0 - v1);
    later = after * dz * (v_jump + v1) / (v0 + v1);
    k_begun_re = (dz > 0.0 ? s->k_held_re : k_re);
    k_begun_co = (dz < 0.0 ? s->k_held_co : k_co);
    kernel_fluid_lag_part(p, s, k_begun_re, k_begun_co, v0, v_jump, s->z - later, dz - later, (1.0 - after) * dt);
    mean = (1.0 - after) * s->F_mean;
    work = s->W_step;
    /* Trapped air is dead stroke first and stiff then. */
    parts = (p->V_air > 0.0 ? 8 : 1);
    begun = v_jump;
    for (i = 1; i < parts + 1; i += 1)
    {
        ended = v_jump + (double)(i) / (double)(parts) * (v1 - v_jump);
        way = later / parts * (begun + ended) / (v_jump + v1);
        at = s->z - later * (1.0 - (double)(i) / (double)(parts)) * (ended + v1) / (v_jump + v1);
        kernel_fluid_lag_part(p, s, s->k_re, s->k_co, begun, ended, at, way, after * dt / parts);
        mean += after / parts * s->F_mean;
        work += s->W_step;
        begun = ended;
    }
    s->F_mean = mean;
    s->W_step = work;
}

/* The force that the rubber lets through, and the rubber's own loss. */
static void kernel_mount_compliance_force(struct kernel_Parameters* p, struct kernel_State* s, double v, double dz, double dt)
{
    double rate;
    if ((dt <= 0.0) && (s->elapsed == 0.0))
    {
        return;
    }
    s->F_valve = s->F_open;
    if (dt <= 0.0)
    {
        s->F_fluid = s->F_mount + s->F_rod;
        s->F_mean += s->F_rod;
        return;
    }
    s->F_rod = p->m_rod * (s->goal_v1 - s->v_piston) / dt;
    s->F_fluid = s->F_mount + s->F_rod;
    s->F_mean = s->F_even + s->F_rod;
    rate = v - s->goal_v1;
    s->v_piston = s->goal_v1;
    s->W_step = s->F_mount * (dz - (s->goal_v1 - s->u_valve) * dt) + p->tau_mount / p->C_mount * rate * rate * dt;
}

static void kernel_effects_force(struct kernel_Parameters* p, struct kernel_State* s, double v, double dz, double dt)
{
    if ((p->C_fluid != 0.0) || (p->C_fluid_co != 0.0) || (p->V_air != 0.0) || (p->tau_fluid != 0.0) || (p->closing_stroke != 0.0))
    {
        kernel_fluid_lag_force(p, s, v, dz, dt);
    }
    if (p->C_mount != 0.0)
    {
        kernel_mount_compliance_force(p, s, v, dz, dt);
    }
    return;
}

/* Take up the step's work, less what of it has already gone. */
static void kernel_oil_temperature_finish(struct kernel_Parameters* p, struct kernel_State* s, double dt)
{
    double share;
    double kept;
    share = dt / p->cooling_time;
    kept = (share > 1e-09 ? (1.0 - exp(-share)) / share : 1.0);
    /* Where stroke and velocity of a record do not agree, a step can do negative work. */
    s->heat = double_max(2, 0.0, s->heat + s->W_step * kept);
}

/* Remember k_degr, and the force where it is not that of the columns: at the start, or with an element in series. */
static void kernel_fluid_lag_finish(struct kernel_Parameters* p, struct kernel_State* s, double dt)
{
    s->k_held_re = s->k_re;
    s->k_held_co = s->k_co;
    if (s->elapsed <= 0.0)
    {
        s->F_late = s->F_valve;
    }
    if (s->F_valve != s->F_held_re - s->F_held_co)
    {
        s->F_held_re = double_max(2, 0.0, s->F_valve);
        s->F_held_co = double_max(2, 0.0, -s->F_valve);
    }
}

static void kernel_effects_finish(struct kernel_Parameters* p, struct kernel_State* s, double dt)
{
    if ((p->fade_heat != 0.0) || (p->fade_kelvin != 0.0) || (p->friction_kelvin != 0.0))
    {
        kernel_oil_temperature_finish(p, s, dt);
    }
    if ((p->C_fluid != 0.0) || (p->C_fluid_co != 0.0) || (p->V_air != 0.0) || (p->tau_fluid != 0.0) || (p->closing_stroke != 0.0))
    {
        kernel_fluid_lag_finish(p, s, dt);
    }
    return;
}

/* Share [1] of the cavitation that the gas already free leaves. */
static double kernel_gas_exhaustion_scale_cavitation(struct kernel_Parameters* p, struct kernel_State* s)
{
    double oil;
    oil = s->V1_oil + s->V1_foam_oil + s->V2_oil + s->V2_foam_oil + s->V3_oil + s->V3_foam_oil + s->V_cav;
    return (oil > 0.0 ? double_max(2, 0.0, 1.0 - p->exhaustion * s->V_cav / oil) : 0.0);
}

static double kernel_effects_scale_cavitation(struct kernel_Parameters* p, struct kernel_State* s)
{
    double value;
    value = 1.0;
    if (p->exhaustion != 0.0)
    {
        value *= kernel_gas_exhaustion_scale_cavitation(p, s);
    }
    return value;
}

/* The kernel's step with the effects around it. */
static bool kernel_extended_part(struct kernel_Parameters* p, struct kernel_Derived* d, struct kernel_State* s, struct kernel_Flow* f, double z, double v0, double v1, double dt)
{
    double work;
    double friction;
    double gas;
    double dz;
    double v;
    double scale;
    double bled;
    double F_1;
    double speed;
    bool done;
    if (dt <= 1e-09)
    {
        dt = 0.0;
    }
    s->duration = dt;
    work = s->work;
    friction = s->F_friction;
    gas = s->F_gas;
    s->goal_z = z;
    s->goal_v0 = v0;
    s->goal_v1 = v1;
    kernel_effects_motion(p, d, s, z, v0, v1, dt);
    dz = s->goal_z - s->z;
    kernel_cavitate(p, d, kernel_effects_scale_cavitation(p, s));
    kernel_effects_phases(p, s, fabs(dz), dt);
    s->k_degr = s->k_flow;
    done = kernel_changed_step(p, d, s, f, s->goal_z, s->goal_v0, s->goal_v1);
    s->k_flow = s->k_degr;
    v = s->goal_v1;
    kernel_effects_transition(p, s, f, v, dz);
    scale = kernel_effects_scale_fluid(p, s, v);
    bled = kernel_effects_scale_valve(p, v);
    s->k_degr *= scale * bled;
    if ((v > 0.0) || ((v == 0.0) && (dz > 0.0)))
    {
        s->k_re = f->k_degr * scale;
    }
    else if ((v < 0.0) || (dz < 0.0))
    {
        s->k_co = f->k_degr * scale;
    }
    kernel_effects_rebalance(p, d, s, v1, dt);
    F_1 = kernel_fluid_force(p, v);
    s->F_fluid = F_1 * s->k_degr;
    F_1 *= bled;
    s->F_friction = s->F_friction * kernel_effects_scale_friction(p, s, s->z, v) + kernel_effects_rub(p, s->z, v);
    s->F_gas += kernel_effects_elastic(p, s, s->z);
    /* As in kernel.step: the mean over the stroke, whose direction need not be that of the velocity at its end. */
    speed = fabs(s->goal_v0 + v) / 2.0;
    s->k_mean = f->k_mean * kernel_effects_scale_fluid(p, s, (dz >= 0.0 ? speed : -speed));
    s->F_mean = 0.5 * (kernel_fluid_force(p, s->goal_v0) * kernel_effects_scale_valve(p, s->goal_v0) + F_1) * s->k_mean;
    s->W_step = s->F_mean * dz;
    s->F_valve = s->F_fluid;
    kernel_effects_force(p, s, v1, dz, dt);
    s->W_step += 0.5 * (friction + s->F_friction) * dz;
    s->impulse += (s->F_mean + 0.5 * (friction + s->F_friction + gas + s->F_gas)) * dt;
    s->work = work + s->W_step;
    s->elapsed += dt;
    kernel_effects_finish(p, s, dt);
    return done;
}

/* `advance` with at least one effect, in as many equal parts as the effects ask for. */
static bool kernel_extended_step(struct kernel_Parameters* p, struct kernel_Derived* d, struct kernel_State* s, struct kernel_Flow* f, double z, double v0, double v1, double dt)
{
    int64_t n;
    double z0;
    double before;
    int64_t i;
    double share;
    double after;
    n = kernel_effects_parts(p, dt);
    /* Stroke and velocity go evenly, each by itself: samples of the two need not agree, at a rest above all. */
    z0 = s->z_rod;
    before = v0;
    for (i = 1; i < n; i += 1)
    {
        share = (double)(i) / (double)(n);
        after = v0 + share * (v1 - v0);
        if (!kernel_extended_part(p, d, s, f, z0 + share * (z - z0), before, after, dt / n))
        {
            return 0;
        }
        before = after;
    }
    s->z_rod = z;
    return kernel_extended_part(p, d, s, f, z, before, v1, dt / n);
}

/* Stroke [m] at which the rod stands. */
static double kernel_rod_stroke(struct kernel_Derived* d, struct kernel_State* s)
{
    return (d->extended == 0 ? s->z : s->z_rod);
}

/* Carry `s` to the stroke `z` [m] while the velocity goes evenly from `v0` to `v1` [m/s].
   Time enters through stroke and velocity only: every process of the paper is tied to the stroke. `k_degr` is the mean
   over the step, the forces are those at its end with that mean. False when the
   step could not be finished within `64`, which no admissible parameter set is known to cause. */
static bool kernel_step(struct kernel_Parameters* p, struct kernel_Derived* d, struct kernel_State* s, struct kernel_Flow* f, double z, double v0, double v1)
{
    double dz;
    double left;
    double foaming;
    double cavitating;
    double acting;
    int64_t splits;
    double way;
    dz = z - s->z;
    left = fabs(dz);
    foaming = kernel_share_above(v0, v1, p->v_foam);
    cavitating = kernel_share_above(v0, v1, p->v_cav);
    acting = 0.0;
    splits = 0;
    while((left > 0.0) && (splits < 64))
    {
        kernel_flows(p, d, s, f, dz, foaming, cavitating);
        way = kernel_carry(s, f, left);
        acting += f->k_degr * way;
        left -= way;
        splits += 1;
    }
    kernel_arrive(p, d, s, f, z, v0, v1, acting);
    return left <= 0.0;
}

/* Carry `s` to the stroke `z` [m] in the time `dt` [s] >= 0, the velocity going evenly from `v0` to `v1` [m/s].
   As `kernel.step`, whose result it returns, but never against the velocity (`rod_goal`); `dt` acts through effects that
   need time and is else ignored. */
static bool kernel_advance(struct kernel_Parameters* p, struct kernel_Derived* d, struct kernel_State* s, struct kernel_Flow* f, double z, double v0, double v1, double dt)
{
    double goal;
    goal = kernel_rod_goal(kernel_rod_stroke(d, s), z, v0, v1);
    if (d->extended == 0)
    {
        return kernel_step(p, d, s, f, goal, v0, v1);
    }
    return kernel_extended_step(p, d, s, f, goal, v0, v1, dt);
}

/* Force of the damper [N] (Eq. 1). */
static double kernel_total_force(struct kernel_State* s)
{
    return s->F_fluid + s->F_friction + s->F_gas;
}

/* Gas in the reserve chamber [m3], the rest of its volume; where rounding would leave less than nothing, nothing. */
static double kernel_reserve_gas(struct kernel_Derived* d, struct kernel_State* s)
{
    return double_max(2, 0.0, d->V_reserve - s->V3_oil - s->V3_foam);
}

static void kernel_publish(struct kernel_Derived* d, struct kernel_State* s, struct kernel_Outputs* o)
{
    o->force = kernel_total_force(s);
    o->k_degr = s->k_degr;
    o->F_fluid = s->F_fluid;
    o->F_friction = s->F_friction;
    o->F_gas = s->F_gas;
    o->work = s->work;
    o->V1_oil = s->V1_oil;
    o->V1_gas = s->V1_gas;
    o->V1_foam = s->V1_foam;
    o->V2_oil = s->V2_oil;
    o->V2_gas = s->V2_gas;
    o->V2_foam = s->V2_foam;
    o->V3_oil = s->V3_oil;
    o->V3_gas = kernel_reserve_gas(d, s);
    o->V3_foam = s->V3_foam;
    o->V_cav = s->V_cav;
}

/* Keep what a message needs. */
static void kernel_note(struct kernel_Violation* violation, int64_t point, double value, double limit)
{
    violation->point = point;
    violation->value = value;
    violation->limit = limit;
}

/* Number 1 to 3 of the first rule beyond `after` that a branch of the F-v curve breaks, else 0. */
static int64_t kernel_branch_rule(array_double_1d velocities, array_double_1d forces, int64_t after, struct kernel_Violation* violation)
{
    int64_t i;
    if ((after < 1) && ((*cspan_at(&velocities, 0)) <= 0.0))
    {
        kernel_note(violation, 1, (*cspan_at(&velocities, 0)), 0.0);
        return 1;
    }
    if (after < 2)
    {
        for (i = 1; i < 20; i += 1)
        {
            if ((*cspan_at(&velocities, i)) <= (*cspan_at(&velocities, i - 1)))
            {
                kernel_note(violation, i + 1, (*cspan_at(&velocities, i)), (*cspan_at(&velocities, i - 1)));
                return 2;
            }
            if ((*cspan_at(&forces, i)) < (*cspan_at(&forces, i - 1)))
            {
                kernel_note(violation, i + 1, (*cspan_at(&forces, i)), (*cspan_at(&forces, i - 1)));
                return 3;
            }
        }
    }
    return 0;
}

/* Number of the first rule beyond `after`, 1 to 6, that the F-v curve breaks, else 0. */
static int64_t kernel_curve_rule(struct kernel_Parameters* p, int64_t after, struct kernel_Violation* violation)
{
    int64_t rule;
    if (after < 3)
    {
        rule = kernel_branch_rule(p->v_re, p->F_re, after, violation);
        if (rule > 0)
        {
            return rule;
        }
    }
    rule = kernel_branch_rule(p->v_co, p->F_co, after - 3, violation);
    return (rule > 0 ? rule + 3 : 0);
}

/* Number of the first rule beyond `after`, 7 to 15, that the dimensions, the oil or the gas break, else 0.
   All parameters must be within their bounds. `d` is overwritten. Where the dimensions do not fit into each other, the
   volumes mean nothing and their rules are not asked. */
static int64_t kernel_fit_rule(struct kernel_Parameters* p, struct kernel_Derived* d, int64_t after, struct kernel_Violation* violation)
{
    double stretched;
    double pushed;
    double ambient;
    double present;
    if ((after < 7) && (p->D_li <= p->D_PR))
    {
        kernel_note(violation, 0, p->D_PR, p->D_li);
        return 7;
    }
    if ((after < 8) && (p->D_li >= p->D_la))
    {
        kernel_note(violation, 0, p->D_li, p->D_la);
        return 8;
    }
    if ((after < 9) && (p->D_la >= p->D_a))
    {
        kernel_note(violation, 0, p->D_la, p->D_a);
        return 9;
    }
    if ((after < 10) && (p->dead_length >= p->h_l))
    {
        kernel_note(violation, 0, p->dead_length, p->h_l);
        return 10;
    }
    if ((after >= 7) && (after <= 11))
    {
        return 0;
    }
    kernel_prepare(p, d);
    if (p->stroke_max >= d->half_length)
    {
        kernel_note(violation, 0, p->stroke_max, d->half_length);
        return 11;
    }
    stretched = d->A_1 * (d->half_length - p->stroke_max) + d->A_2 * (d->half_length + p->stroke_max);
    if ((after < 12) && (p->V_oil < stretched))
    {
        kernel_note(violation, 0, p->V_oil, stretched);
        return 12;
    }
    pushed = d->A_1 * (d->half_length + p->stroke_max) + d->A_2 * (d->half_length - p->stroke_max) + d->V_reserve;
    if ((after < 13) && (p->V_oil > pushed))
    {
        kernel_note(violation, 0, p->V_oil, pushed);
        return 13;
    }
    if (p->polytropic > 0)
    {
        /* Of both states: the preload may be lost later. The exponent has no say in whether there is room. */
        ambient = 100000.0 * d->A_rod / p->stroke_max;
        present = ambient + p->F_0 / p->stroke_max;
        if ((after < 14) && (p->c_gas >= present))
        {
            kernel_note(violation, 0, p->c_gas, present);
            return 14;
        }
        if ((after < 15) && (p->c_gas_lost >= ambient))
        {
            kernel_note(violation, 0, p->c_gas_lost, ambient);
            return 15;
        }
    }
    return 0;
}

/* Difference [s] of two communication points that is rounding: importers add up their steps, and end on a rest. */
static double kernel_time_slack(double time, double step)
{
    return 1e-09 * (1.0 + fabs(time)) + 0.001 * step;
}

/* 1 where a restored state can be that of a damper: the piston in the tube, no phase below zero; else 0. */
static int64_t kernel_possible(struct kernel_Derived* d, struct kernel_State* s)
{
    if ((fabs(s->z) > kernel_stroke_limit(d)) || (s->k_degr < 0.0))
    {
        return 0;
    }
    if ((s->V1_oil < -1e-12) || (s->V1_gas < -1e-12) || (s->V1_foam < -1e-12) || (s->V1_foam_oil < -1e-12))
    {
        return 0;
    }
    if ((s->V2_oil < -1e-12) || (s->V2_gas < -1e-12) || (s->V2_foam < -1e-12) || (s->V2_foam_oil < -1e-12))
    {
        return 0;
    }
    return ((s->V3_oil < -1e-12) || (s->V3_foam < -1e-12) || (s->V3_foam_oil < -1e-12) ? 0 : 1);
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

/* The checks of twintube/checks.py with the same messages: bounds of the table, and what must hold between parameters. */
#ifndef CHECKS_H
#define CHECKS_H

#include "unit.h"

#define CLEARANCE 1e-6 /* [m] the piston may come this close to the ends of its chambers */

static int within(double value, double low, double high)
{
    return value >= low && value <= high && value - value == 0.0; /* no NaN, no infinity */
}

/* Whether a value is a number within its bounds; else a message is logged. */
static int inside(struct unit *u, const char *name, double value, double low, double high, const char *unit)
{
    if (within(value, low, high))
        return 1;
    refuse(u, "%s = %g %s: must be a number from %g to %g %s", name, value, unit, low, high, unit);
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

static int monotone(struct unit *u, const char *branch, const double *v, const double *F)
{
    if (v[0] <= 0.0) {
        refuse(u, "fv.%s: velocity 1 = %g m/s must be above 0", branch, v[0]);
        return 0;
    }
    for (int i = 1; i < FV_POINTS; i++) {
        if (v[i] <= v[i - 1]) {
            refuse(u, "fv.%s: velocity %d = %g m/s must be above velocity %d = %g m/s", branch, i + 1, v[i], i, v[i - 1]);
            return 0;
        }
        if (F[i] < F[i - 1]) {
            refuse(u, "fv.%s: not monotone, force %d = %g N must be at least force %d = %g N", branch, i + 1, F[i], i, F[i - 1]);
            return 0;
        }
    }
    return 1;
}

static int thinner(struct unit *u, const char *thin, double a, const char *wide, double b)
{
    if (a < b)
        return 1;
    refuse(u, "geometry.%s = %g m: must be below geometry.%s = %g m", thin, a, wide, b);
    return 0;
}

/* Whether the dimensions fit into each other and the oil into the damper. */
static int consistent(struct unit *u, struct kernel_Parameters *p)
{
    struct kernel_Derived d;
    double stretched, pushed;
    if (!thinner(u, "D_PR", p->D_PR, "D_li", p->D_li) || !thinner(u, "D_li", p->D_li, "D_la", p->D_la)
        || !thinner(u, "D_la", p->D_la, "D_a", p->D_a) || !thinner(u, "dead_length", p->dead_length, "h_l", p->h_l))
        return 0;
    memset(&d, 0, sizeof d);
    kernel_prepare(p, &d);
    if (p->stroke_max >= d.half_length) {
        refuse(u, "geometry.stroke_max = %g m: must be below %g m, half of h_l - dead_length", p->stroke_max, d.half_length);
        return 0;
    }
    stretched = d.A_1 * (d.half_length - p->stroke_max) + d.A_2 * (d.half_length + p->stroke_max);
    if (p->V_oil < stretched) {
        refuse(u, "geometry.V_oil = %g m3: must be at least %g m3, or the intact damper draws gas in rebound", p->V_oil, stretched);
        return 0;
    }
    pushed = d.A_1 * (d.half_length + p->stroke_max) + d.A_2 * (d.half_length - p->stroke_max) + d.V_reserve;
    if (p->V_oil > pushed) {
        refuse(u, "geometry.V_oil = %g m3: must be at most %g m3, the room at full compression", p->V_oil, pushed);
        return 0;
    }
    return 1;
}

/* Whether a parameter set is admissible; bounds were checked when it was set. */
static int admissible(struct unit *u, struct damper *damper)
{
    return monotone(u, "rebound", damper->fv[0], damper->fv[1]) && monotone(u, "compression", damper->fv[2], damper->fv[3])
        && consistent(u, &damper->p);
}

#endif

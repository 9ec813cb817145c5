/* Random numbers of all kinds, for the variables of the table. */
#ifndef DRAWS_H
#define DRAWS_H

#include "unit.h"

static uint64_t randomness;

static uint64_t drawn(uint64_t below)
{
    randomness ^= randomness << 13, randomness ^= randomness >> 7, randomness ^= randomness << 17;
    return (randomness * 2685821657736338717u >> 33) % below;
}

static double uniform(double low, double high)
{
    return low + (high - low) * (double)drawn(1 << 30) / (1 << 30);
}

static double any_number(void)
{
    static const double odd[] = {NAN, INFINITY, -INFINITY, 0.0, -0.0, 1e300, -1e300, 1.7e308, 5e-324, -1e-310, 1e-16, 1.0};
    uint64_t bits = drawn(1u << 30) << 34 ^ drawn(1u << 30) << 10 ^ drawn(1u << 30);
    double value;
    if (drawn(2))
        return odd[drawn(sizeof odd / sizeof *odd)];
    if (drawn(2))
        return uniform(-2.0, 2.0);
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Mostly within the bounds, often near the start value or at an end. */
static double number_for(unsigned vr)
{
    const struct variable *v = vr < VARIABLES ? &VARIABLE[vr] : NULL;
    const uint64_t kind = drawn(10);
    if (v == NULL || kind == 0)
        return any_number();
    if (kind < 7)
        return kind == 5 ? v->min : kind == 6 ? v->max : VALUES.start[vr] * uniform(0.9, 1.1);
    return v->max < INFINITY ? uniform(v->min, v->max) : uniform(0.0, 3.0);
}

static unsigned any_reference(void)
{
    const uint64_t kind = drawn(20);
    return (unsigned)(kind == 0 ? drawn(1u << 31) * 2 + 1 : drawn(kind < 4 ? 2 : VARIABLES + 1));
}

#endif

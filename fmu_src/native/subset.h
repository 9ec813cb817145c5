/* What the translated equations use of pyccel's libraries: read access to the F-v curve, min and max as in Python. */
#ifndef SUBSET_H
#define SUBSET_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#ifndef M_PI
#define M_PI 3.14159265358979323846
#endif

typedef struct {
    double *data;
} array_double_1d;

#define cspan_at(array, i) ((array)->data + (i))

/* Both take two values only; `n` is their number. */
static double double_max(int n, double a, double b)
{
    (void)n;
    return b > a ? b : a;
}

static double double_min(int n, double a, double b)
{
    (void)n;
    return b < a ? b : a;
}

static int64_t int64_t_max(int n, int64_t a, int64_t b)
{
    (void)n;
    return b > a ? b : a;
}

#endif

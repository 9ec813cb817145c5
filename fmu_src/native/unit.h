/* One instance of a model: what it remembers, how it is described, how it speaks. No global state, and nothing of one version
   of FMI. */
#ifndef UNIT_H
#define UNIT_H

#include <limits.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernel.h"
#include "messages.h"
#include "memory.h"
#include "version.h"

#define STEEPEST 1e6 /* derivatives of inputs, per second */

enum status { DONE, WARNED, DISCARDED, REFUSED }; /* numbered as in FMI 2.0 and 3.0 */
enum kind { REAL, INTEGER };
enum causality { INPUT, OUTPUT, FIXED, TUNABLE, INDEPENDENT };
enum mode { INSTANTIATED, INITIALIZING, STEPPING, TERMINATED };

/* Everything that changes: an FMU state is a copy of it. */
struct memory {
    struct parameters in_force;
    struct parameters wanted; /* with the parameters set since the last step */
    struct model now;
    double rate;       /* [1/s] input derivative, for the coming attempt at a step */
    double time, stop; /* [s] */
    int32_t mode;
    int32_t timed;   /* whether `time` is known */
    int32_t changed; /* whether `wanted` differs from `in_force` */
    int32_t stale;   /* whether the start has to be computed again */
    int32_t warned;    /* of a velocity that does not belong to its stroke */
    int32_t long_step; /* whether a step longer than SAFE_STEP was warned of */
};

struct variable {
    const char *name, *unit; /* the unit as it follows a number: with a space before it, empty where there is none */
    enum kind kind;
    enum causality causality;
    size_t length; /* of the array that begins here; 0 where it began in a row before */
    size_t offset; /* in struct memory; parameters are those of `wanted` */
    double min, max;
};

struct unit {
    struct memory m;
    void (*tell)(const struct unit *u, enum status status, const char *category, char *text);
    void (*log)(void); /* the importer's, of the type that `tell` knows */
    void *environment; /* the importer's */
    void *(*allocate)(size_t n, size_t size);
    void (*release)(void *memory);
    int says_errors, says_warnings;
    char *name;
};

#include "variables.h"

#define VARIABLES ((unsigned)(sizeof(VARIABLE) / sizeof(VARIABLE[0])) - !ARRAYS) /* the time is the last row */

/* What tells an FMU from others of its model; start values by value references. */
struct values {
    char guid[64];
    double start[VARIABLES];
};

#include "model.h" /* VALUES */

static const char LOG_ERROR[] = "logStatusError";
static const char LOG_WARNING[] = "logStatusWarning";

/* Log a message and return its status. */
static enum status say(struct unit *u, enum status status, const char *format, ...)
{
    char text[512];
    va_list arguments;
    const int wanted = status == WARNED ? u->says_warnings : u->says_errors;
    if (u->log && wanted) {
        va_start(arguments, format);
        vsnprintf(text, sizeof text, format, arguments);
        va_end(arguments);
        u->tell(u, status, status == WARNED ? LOG_WARNING : LOG_ERROR, text);
    }
    return status;
}

/* For `return refuse(...)`; discard is for a question that has no answer here. */
#define refuse(u, ...) say(u, REFUSED, __VA_ARGS__)
#define discard(u, ...) say(u, DISCARDED, __VA_ARGS__)
#define warn(u, ...) say(u, WARNED, __VA_ARGS__)

static double *real_of(struct memory *m, const struct variable *v)
{
    return (double *)((char *)m + v->offset);
}

static int64_t *integer_of(struct memory *m, const struct variable *v)
{
    return (int64_t *)((char *)m + v->offset);
}

/* As after the instantiation: all start values, at rest. */
static void restart(struct memory *m)
{
    memset(m, 0, sizeof *m);
    for (unsigned i = 0; i < VARIABLES; i++) {
        if (VARIABLE[i].kind == INTEGER)
            *integer_of(m, &VARIABLE[i]) = (int64_t)VALUES.start[i];
        else
            *real_of(m, &VARIABLE[i]) = VALUES.start[i];
    }
    m->in_force = m->wanted;
    m->stop = INFINITY;
    m->mode = INSTANTIATED;
    m->stale = 1;
}

#endif

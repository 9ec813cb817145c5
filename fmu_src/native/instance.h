/* The life of an instance, as both versions of FMI see it; `function` is what the importer called. */
#ifndef INSTANCE_H
#define INSTANCE_H

#include "step.h"

#define EVERYWHERE (1 << INSTANTIATED | 1 << INITIALIZING | 1 << STEPPING | 1 << TERMINATED)
#define BEFORE_THE_END (EVERYWHERE & ~(1 << TERMINATED))

/* Whether a function may be called now; else a message is logged. */
static int allowed(struct unit *u, const char *function, int modes)
{
    if (u == NULL)
        return 0;
    if (modes >> u->m.mode & 1)
        return 1;
    refuse(u, SAY_NOT_NOW, function, MODE[u->m.mode]);
    return 0;
}

static int given(struct unit *u, const char *function, const void *a, const void *b, size_t n)
{
    if (n == 0 || (a != NULL && b != NULL))
        return 1;
    refuse(u, "%s: null pointer for %u values", function, (unsigned)n);
    return 0;
}

/* A new instance that speaks and reserves memory as `blank`; NULL and a message where it cannot be. `key` is what the importer
   has from the model description, where it is called `label`. */
static struct unit *created(struct unit *blank, const char *function, const char *name, const char *label, const char *key)
{
    struct unit *u;
    blank->name = (char *)(name ? name : "");
    if (*blank->name == 0)
        return refuse(blank, "%s: the instance has no name", function), NULL;
    if (key == NULL || strcmp(key, VALUES.guid) != 0)
        return refuse(blank, "%s: %s = %s: this binary belongs to %s", function, label, key ? key : "null",
                      VALUES.guid), NULL;
    u = blank->allocate(1, sizeof *u);
    if (u == NULL)
        return refuse(blank, "%s: no memory", function), NULL;
    *u = *blank;
    u->name = blank->allocate(1, strlen(name) + 1);
    if (u->name == NULL) {
        blank->release(u);
        return refuse(blank, "%s: no memory", function), NULL;
    }
    strcpy(u->name, name);
    restart(&u->m);
    return u;
}

static void freed(struct unit *u)
{
    if (u == NULL)
        return;
    u->release(u->name);
    u->release(u);
}

/* Whether messages of the categories are wanted; without categories, all of them. */
static enum status listen(struct unit *u, const char *function, int on, size_t n, const char *const categories[])
{
    if (!allowed(u, function, EVERYWHERE) || !given(u, function, categories, categories, n))
        return REFUSED;
    for (size_t i = 0; i < n; i++) {
        if (categories[i] == NULL || (strcmp(categories[i], LOG_ERROR) && strcmp(categories[i], LOG_WARNING)))
            return refuse(u, "%s: no category %s", function, categories[i] ? categories[i] : "null");
    }
    for (size_t i = 0; i < n; i++)
        *(strcmp(categories[i], LOG_ERROR) ? &u->says_warnings : &u->says_errors) = on;
    if (n == 0)
        u->says_errors = u->says_warnings = on;
    return DONE;
}

static enum status set_times(struct unit *u, const char *function, double start, int has_stop, double stop)
{
    if (!allowed(u, function, 1 << INSTANTIATED) || !inside(u, "start time", start, -LONGEST, LONGEST, " s")
        || (has_stop && !(stop >= start) && !inside(u, "stop time", stop, start, LONGEST, " s")))
        return REFUSED;
    u->m.time = start;
    u->m.timed = 1;
    u->m.stop = has_stop ? stop : INFINITY;
    return DONE;
}

static enum status enter_initialization(struct unit *u, const char *function)
{
    if (!allowed(u, function, 1 << INSTANTIATED))
        return REFUSED;
    u->m.mode = INITIALIZING;
    return DONE;
}

static enum status exit_initialization(struct unit *u, const char *function)
{
    if (!allowed(u, function, 1 << INITIALIZING) || !begin(u))
        return REFUSED;
    u->m.mode = STEPPING;
    return DONE;
}

static enum status terminate(struct unit *u, const char *function)
{
    if (!allowed(u, function, 1 << STEPPING))
        return REFUSED;
    u->m.mode = TERMINATED;
    return DONE;
}

static enum status reset(struct unit *u, const char *function)
{
    if (!allowed(u, function, EVERYWHERE))
        return REFUSED;
    restart(&u->m);
    return DONE;
}

static enum status do_step(struct unit *u, const char *function, double time, double h)
{
    enum status status;
    double slack, last, rate;
    if (!allowed(u, function, 1 << STEPPING))
        return REFUSED;
    /* Inputs and their derivatives belong to the beginning of a communication step (FMI 2.0, 4.2.1). The attempt uses the
       derivative up: after a refused step importers set inputs anew, and what was meant for others must not act on these. */
    rate = u->m.rate;
    u->m.rate = 0.0;
    if (!inside(u, "communication point", time, -LONGEST, LONGEST, " s")
        || !inside(u, "communication step", h, 0.0, LONGEST, " s"))
        return REFUSED;
    slack = kernel_time_slack(time, h);
    if (u->m.timed && fabs(time - u->m.time) > slack)
        return refuse(u, SAY_MISTIMED, time, u->m.time);
    if (time + h > u->m.stop + slack)
        return refuse(u, SAY_BEYOND_STOP, h, time, u->m.stop);
    last = u->m.time;
    u->m.time = time;
    status = move(u, h, rate);
    u->m.time = status <= WARNED ? time + h : last;
    u->m.timed |= status <= WARNED;
    return status;
}

#endif

/* Instances of FMI 3.0 that count their messages, and what is asked after each of their calls. */
#ifndef FMU3_H
#define FMU3_H

#include "fmi3Functions.h"
#include "unit.h" /* the table of variables */

#define STATES 3
#define ROOM 16384 /* bytes, more than a state has */
#define MOST (2 * (sizeof VARIABLE / sizeof VARIABLE[0]))

#define CHECK(condition, ...)                                                       \
    do {                                                                            \
        if (!(condition)) {                                                         \
            fprintf(stderr, "%s:%d: not so: %s: ", __FILE__, __LINE__, #condition); \
            fprintf(stderr, __VA_ARGS__);                                           \
            fprintf(stderr, "\n");                                                  \
            exit(1);                                                                \
        }                                                                           \
    } while (0)

struct slot {
    fmi3Instance c;
    fmi3FMUState state[STATES];
    int messages;
    char text[1024];
    double time, z, v; /* of a motion that is possible */
};

/* All that can be asked for: the bytes of the state, and the outputs where they can be computed. */
struct picture {
    fmi3Byte bytes[ROOM];
    size_t size;
    fmi3Status status;
    double output[32];
};

static fmi3ValueReference output[32];
static size_t outputs;
static long calls, steps, refusals;

static void listen_to(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message)
{
    struct slot *s = environment;
    CHECK(category != NULL && *message && status >= fmi3Warning && status <= fmi3Error, "status %d", (int)status);
    snprintf(s->text, sizeof s->text, "%s", message);
    s->messages++;
}

static struct picture taken(struct slot *s)
{
    static const struct picture empty;
    struct picture p = empty;
    fmi3FMUState state = NULL;
    const int messages = s->messages;
    p.status = fmi3GetFloat64(s->c, output, outputs, p.output, outputs);
    CHECK(fmi3GetFMUState(s->c, &state) == fmi3OK, "%s", s->text);
    CHECK(fmi3SerializedFMUStateSize(s->c, state, &p.size) == fmi3OK && p.size <= ROOM, "%zu bytes", p.size);
    CHECK(fmi3SerializeFMUState(s->c, state, p.bytes, p.size) == fmi3OK, "%s", s->text);
    CHECK(fmi3FreeFMUState(s->c, &state) == fmi3OK && state == NULL, "%s", s->text);
    s->messages = messages;
    return p;
}

/* The memory in a picture, apart from what a refused step may do unseen: take over parameters that waited for it. */
static struct memory seen(const struct picture *p)
{
    struct memory m;
    memcpy(&m, p->bytes + p->size - sizeof m, sizeof m);
    m.in_force = m.wanted;
    m.changed = 0;
    memset(&m.now.d, 0, sizeof m.now.d);
    m.now.limit = 0.0;
    return m;
}

static int same(const struct picture *a, const struct picture *b)
{
    const struct memory x = seen(a), y = seen(b);
    return a->status == b->status && memcmp(&x, &y, sizeof x) == 0 && memcmp(a->output, b->output, sizeof a->output) == 0;
}

static void judge(struct slot *s, const struct picture *before, int messages, fmi3Status status, const char *call)
{
    struct picture after;
    calls++;
    CHECK(status == fmi3OK || status == fmi3Warning || status == fmi3Error, "%s: status %d", call, (int)status);
    if (status <= fmi3Warning) {
        CHECK(status == fmi3OK || s->messages > messages, "%s: a warning without a message", call);
        return;
    }
    after = taken(s);
    refusals++;
    CHECK(s->messages > messages, "%s: refused without a message", call);
    CHECK(same(before, &after), "%s: changed though refused: %s", call, s->text);
}

/* To be used with a slot `s`, a picture `before` and a `status`. */
#define TRY(call)                                   \
    do {                                            \
        const int messages = s->messages;           \
        before = taken(s);                          \
        status = (call);                            \
        judge(s, &before, messages, status, #call); \
    } while (0)

static void check_sound(struct slot *s)
{
    double values[32];
    CHECK(fmi3GetFloat64(s->c, output, outputs, values, outputs) == fmi3OK, "%s", s->text);
    for (size_t k = 0; k < outputs; k++) {
        const struct variable *v = &VARIABLE[output[k]];
        CHECK(values[k] - values[k] == 0.0 && values[k] >= v->min - 1e-12 && values[k] <= v->max, "%s = %g", v->name, values[k]);
    }
}

#endif

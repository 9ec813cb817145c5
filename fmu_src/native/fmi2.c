/* FMI 2.0 for co-simulation; the only file to compile. The equations are in kernel.h, the table of variables with the start
   values in variables.h. */
#include "step.h"

#define EVERYWHERE (1 << INSTANTIATED | 1 << INITIALIZING | 1 << STEPPING | 1 << TERMINATED)

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

static void *reserve(struct unit *u, size_t size)
{
    return u->allocate ? u->allocate(1, size) : calloc(1, size);
}

static void drop(struct unit *u, void *memory)
{
    if (u->release)
        u->release(memory);
    else
        free(memory);
}

const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void)
{
    return fmi2Version;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean logging)
{
    struct unit blank, *u;
    (void)resources, (void)visible, (void)logging;
    memset(&blank, 0, sizeof blank);
    if (functions == NULL)
        return NULL;
    /* Warnings and errors are said unless fmi2SetDebugLogging turns them off: there is no other debug output. */
    blank.log = functions->logger;
    blank.environment = functions->componentEnvironment;
    blank.says_errors = blank.says_warnings = 1;
    blank.name = (char *)(name && *name ? name : "");
    if (functions->allocateMemory && functions->freeMemory) {
        blank.allocate = functions->allocateMemory;
        blank.release = functions->freeMemory;
    }
    if (*blank.name == 0)
        return refuse(&blank, "fmi2Instantiate: the instance has no name"), NULL;
    if (type != fmi2CoSimulation)
        return refuse(&blank, "fmi2Instantiate: this FMU is for co-simulation only"), NULL;
    if (guid == NULL || strcmp(guid, MODEL_GUID) != 0)
        return refuse(&blank, "fmi2Instantiate: guid = %s: this binary belongs to " MODEL_GUID, guid ? guid : "null"), NULL;
    u = reserve(&blank, sizeof *u);
    if (u == NULL)
        return refuse(&blank, "fmi2Instantiate: no memory"), NULL;
    *u = blank;
    u->name = reserve(u, strlen(name) + 1);
    if (u->name == NULL) {
        drop(&blank, u);
        return refuse(&blank, "fmi2Instantiate: no memory"), NULL;
    }
    strcpy(u->name, name);
    restart(&u->m);
    return u;
}

void fmi2FreeInstance(fmi2Component c)
{
    struct unit *u = c;
    if (u == NULL)
        return;
    drop(u, u->name);
    drop(u, u);
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String categories[])
{
    struct unit *u = c;
    if (!allowed(u, "fmi2SetDebugLogging", EVERYWHERE) || !given(u, "fmi2SetDebugLogging", categories, categories, n))
        return fmi2Error;
    for (size_t i = 0; i < n; i++) {
        if (categories[i] == NULL || (strcmp(categories[i], LOG_ERROR) && strcmp(categories[i], LOG_WARNING)))
            return refuse(u, "fmi2SetDebugLogging: no category %s", categories[i] ? categories[i] : "null");
    }
    for (size_t i = 0; i < n; i++)
        *(strcmp(categories[i], LOG_ERROR) ? &u->says_warnings : &u->says_errors) = on != 0;
    if (n == 0)
        u->says_errors = u->says_warnings = on != 0;
    return fmi2OK;
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean toleranceDefined, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean stopDefined, fmi2Real stop)
{
    struct unit *u = c;
    (void)toleranceDefined, (void)tolerance;
    if (!allowed(u, "fmi2SetupExperiment", 1 << INSTANTIATED) || !inside(u, "start time", start, -LONGEST, LONGEST, " s")
        || (stopDefined && !(stop >= start) && !inside(u, "stop time", stop, start, LONGEST, " s")))
        return fmi2Error;
    u->m.time = start;
    u->m.timed = 1;
    u->m.stop = stopDefined ? stop : INFINITY;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    struct unit *u = c;
    if (!allowed(u, "fmi2EnterInitializationMode", 1 << INSTANTIATED))
        return fmi2Error;
    u->m.mode = INITIALIZING;
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    struct unit *u = c;
    if (!allowed(u, "fmi2ExitInitializationMode", 1 << INITIALIZING) || !begin(u))
        return fmi2Error;
    u->m.mode = STEPPING;
    return fmi2OK;
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    struct unit *u = c;
    if (!allowed(u, "fmi2Terminate", 1 << STEPPING))
        return fmi2Error;
    u->m.mode = TERMINATED;
    return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component c)
{
    struct unit *u = c;
    if (!allowed(u, "fmi2Reset", EVERYWHERE))
        return fmi2Error;
    restart(&u->m);
    return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real h, fmi2Boolean noSetPrior)
{
    struct unit *u = c;
    fmi2Status status;
    double slack, last, rate;
    (void)noSetPrior;
    if (!allowed(u, "fmi2DoStep", 1 << STEPPING))
        return fmi2Error;
    /* Inputs and their derivatives belong to the beginning of a communication step (FMI 2.0, 4.2.1). The attempt uses the
       derivative up: after a refused step importers set inputs anew, and what was meant for others must not act on these. */
    rate = u->m.rate;
    u->m.rate = 0.0;
    if (!inside(u, "communication point", time, -LONGEST, LONGEST, " s")
        || !inside(u, "communication step", h, 0.0, LONGEST, " s"))
        return fmi2Error;
    slack = kernel_time_slack(time, h);
    if (u->m.timed && fabs(time - u->m.time) > slack)
        return refuse(u, SAY_MISTIMED, time, u->m.time);
    if (time + h > u->m.stop + slack)
        return refuse(u, SAY_BEYOND_STOP, h, time, u->m.stop);
    last = u->m.time;
    u->m.time = time;
    status = move(u, h, rate);
    u->m.time = status <= fmi2Warning ? time + h : last;
    u->m.timed |= status <= fmi2Warning;
    return status;
}

fmi2Status fmi2CancelStep(fmi2Component c)
{
    struct unit *u = c;
    return u ? refuse(u, "fmi2CancelStep: steps are never pending") : fmi2Error;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    struct unit *u = c;
    if (!allowed(u, "fmi2GetRealStatus", EVERYWHERE) || !given(u, "fmi2GetRealStatus", value, value, 1))
        return fmi2Error;
    if (kind != fmi2LastSuccessfulTime)
        return discard(u, "fmi2GetRealStatus: only the last successful time is known");
    *value = u->m.time;
    return fmi2OK;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    struct unit *u = c;
    if (!allowed(u, "fmi2GetBooleanStatus", EVERYWHERE) || !given(u, "fmi2GetBooleanStatus", value, value, 1))
        return fmi2Error;
    if (kind != fmi2Terminated)
        return discard(u, "fmi2GetBooleanStatus: only whether the unit wants to end is known");
    *value = fmi2False;
    return fmi2OK;
}

static fmi2Status pending(fmi2Component c, const char *function)
{
    struct unit *u = c;
    return u ? discard(u, "%s: steps are never pending", function) : fmi2Error;
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value)
{
    (void)kind, (void)value;
    return pending(c, "fmi2GetStatus");
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value)
{
    (void)kind, (void)value;
    return pending(c, "fmi2GetIntegerStatus");
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value)
{
    (void)kind, (void)value;
    return pending(c, "fmi2GetStringStatus");
}

#include "access.h"
#include "state.h"

/* FMI 2.0 for co-simulation; the only file to compile. The equations are in kernel.h, the table of variables in variables.h,
   start values in model.h, what an instance does in instance.h, access.h and state.h. */
#include "access.h"
#include "state.h"

#include "fmi2Functions.h"

/* Loggers expand % and #, which an importer's own words may hold. */
static void tell(const struct unit *u, enum status status, const char *category, char *text)
{
    for (char *mark = text; (mark = strpbrk(mark, "%#")) != NULL;)
        *mark = '?';
    ((fmi2CallbackLogger)u->log)(u->environment, u->name, (fmi2Status)status, category, text);
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
    struct unit blank;
    (void)resources, (void)visible, (void)logging;
    memset(&blank, 0, sizeof blank);
    if (functions == NULL)
        return NULL;
    /* Warnings and errors are said unless fmi2SetDebugLogging turns them off: there is no other debug output. */
    blank.tell = tell;
    blank.log = (void (*)(void))functions->logger;
    blank.environment = functions->componentEnvironment;
    blank.says_errors = blank.says_warnings = 1;
    blank.allocate = calloc;
    blank.release = free;
    if (functions->allocateMemory && functions->freeMemory) {
        blank.allocate = functions->allocateMemory;
        blank.release = functions->freeMemory;
    }
    if (type != fmi2CoSimulation) {
        blank.name = "";
        return refuse(&blank, "fmi2Instantiate: this FMU is for co-simulation only"), NULL;
    }
    return created(&blank, "fmi2Instantiate", name, "guid", guid);
}

void fmi2FreeInstance(fmi2Component c)
{
    freed(c);
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String categories[])
{
    return (fmi2Status)listen(c, "fmi2SetDebugLogging", on != 0, n, categories);
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean toleranceDefined, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean stopDefined, fmi2Real stop)
{
    (void)toleranceDefined, (void)tolerance;
    return (fmi2Status)set_times(c, "fmi2SetupExperiment", start, stopDefined != 0, stop);
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    return (fmi2Status)enter_initialization(c, "fmi2EnterInitializationMode");
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    return (fmi2Status)exit_initialization(c, "fmi2ExitInitializationMode");
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    return (fmi2Status)terminate(c, "fmi2Terminate");
}

fmi2Status fmi2Reset(fmi2Component c)
{
    return (fmi2Status)reset(c, "fmi2Reset");
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real h, fmi2Boolean noSetPrior)
{
    (void)noSetPrior;
    return (fmi2Status)do_step(c, "fmi2DoStep", time, h);
}

/* Values */

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Real value[])
{
    return (fmi2Status)get_reals(c, "fmi2GetReal", vr, n, value, n);
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Integer value[])
{
    return (fmi2Status)get_integers(c, "fmi2GetInteger", vr, n, value, n);
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Real value[])
{
    return (fmi2Status)set_reals(c, "fmi2SetReal", vr, n, value, n);
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Integer value[])
{
    return (fmi2Status)set_integers(c, "fmi2SetInteger", vr, n, value, n);
}

#define WITHOUT(name, what, type)                                                                   \
    fmi2Status name(fmi2Component c, const fmi2ValueReference vr[], size_t n, type value[])          \
    {                                                                                                \
        (void)vr, (void)value;                                                                       \
        return (fmi2Status)none(c, #name, what, n);                                                  \
    }
WITHOUT(fmi2GetBoolean, "Boolean variable", fmi2Boolean)
WITHOUT(fmi2GetString, "String variable", fmi2String)
WITHOUT(fmi2SetBoolean, "Boolean variable", const fmi2Boolean)
WITHOUT(fmi2SetString, "String variable", const fmi2String)

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Integer order[],
                                       const fmi2Real value[])
{
    static const char NAME[] = "fmi2SetRealInputDerivatives";
    struct unit *u = c;
    if (!allowed(u, NAME, BEFORE_THE_END) || !given(u, NAME, vr, value, n) || !given(u, NAME, order, order, n))
        return fmi2Error;
    for (size_t i = 0; i < n; i++) {
        const struct variable *v = find(u, NAME, vr[i], REAL);
        if (v == NULL)
            return fmi2Error;
        if (v->causality != INPUT || order[i] != 1)
            return (fmi2Status)refuse(u, "%s: derivatives are those of inputs and of order 1, not %d", v->name, (int)order[i]);
        if (!inside(u, "derivative of an input", value[i], -STEEPEST, STEEPEST, " per second"))
            return fmi2Error;
    }
    for (size_t i = 0; i < n; i++) {
        if (VARIABLE[vr[i]].offset == DERIVED_INPUT)
            u->m.rate = value[i];
    }
    return fmi2OK;
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Integer order[],
                                        fmi2Real value[])
{
    (void)vr, (void)order, (void)value;
    return (fmi2Status)none(c, "fmi2GetRealOutputDerivatives", "output derivative", n);
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[], size_t n,
                                        const fmi2ValueReference known[], size_t k, const fmi2Real dknown[], fmi2Real dunknown[])
{
    (void)unknown, (void)known, (void)k, (void)dknown, (void)dunknown;
    return (fmi2Status)none(c, "fmi2GetDirectionalDerivative", "directional derivative", n);
}

/* States */

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    return (fmi2Status)get_state(c, "fmi2GetFMUstate", state);
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state)
{
    return (fmi2Status)set_state(c, "fmi2SetFMUstate", state);
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    return (fmi2Status)free_state(c, "fmi2FreeFMUstate", state);
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    return (fmi2Status)serialized_size(c, "fmi2SerializedFMUstateSize", state, size);
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    return (fmi2Status)serialize(c, "fmi2SerializeFMUstate", state, bytes, size);
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state)
{
    return (fmi2Status)deserialize(c, "fmi2DeSerializeFMUstate", bytes, size, state);
}

/* Steps are never pending. */

fmi2Status fmi2CancelStep(fmi2Component c)
{
    return c ? (fmi2Status)refuse((struct unit *)c, "fmi2CancelStep: steps are never pending") : fmi2Error;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    struct unit *u = c;
    if (!allowed(u, "fmi2GetRealStatus", EVERYWHERE) || !given(u, "fmi2GetRealStatus", value, value, 1))
        return fmi2Error;
    if (kind != fmi2LastSuccessfulTime)
        return (fmi2Status)discard(u, "fmi2GetRealStatus: only the last successful time is known");
    *value = u->m.time;
    return fmi2OK;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    struct unit *u = c;
    if (!allowed(u, "fmi2GetBooleanStatus", EVERYWHERE) || !given(u, "fmi2GetBooleanStatus", value, value, 1))
        return fmi2Error;
    if (kind != fmi2Terminated)
        return (fmi2Status)discard(u, "fmi2GetBooleanStatus: only whether the unit wants to end is known");
    *value = fmi2False;
    return fmi2OK;
}

static fmi2Status pending(struct unit *u, const char *function)
{
    return u ? (fmi2Status)discard(u, "%s: steps are never pending", function) : fmi2Error;
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

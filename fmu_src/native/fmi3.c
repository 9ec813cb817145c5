/* FMI 3.0 for co-simulation; the only file to compile. The equations are in kernel.h, the table of variables in variables.h,
   start values in model.h, what an instance does in instance.h, access.h and state.h. */
#include "access.h"
#include "state.h"

#include "fmi3Functions.h"
#include "fmi3_absent.h"

static void tell(const struct unit *u, enum status status, const char *category, char *text)
{
    ((fmi3LogMessageCallback)u->log)(u->environment, (fmi3Status)status, category, text);
}

const char *fmi3GetVersion(void)
{
    return fmi3Version;
}

/* An instance that is still nothing but able to speak. Errors are always said (FMI 3.0.3, 2.2.4), warnings where they are
   wanted. */
static struct unit mouth(fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, fmi3Boolean logging)
{
    struct unit blank;
    memset(&blank, 0, sizeof blank);
    blank.tell = tell;
    blank.log = (void (*)(void))log;
    blank.environment = environment;
    blank.says_errors = 1;
    blank.says_warnings = logging;
    blank.allocate = calloc;
    blank.release = free;
    blank.name = "";
    return blank;
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                         fmi3Boolean logging, fmi3Boolean eventMode, fmi3Boolean earlyReturn,
                                         const fmi3ValueReference required[], size_t n, fmi3InstanceEnvironment environment,
                                         fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback update)
{
    static const char NAME[] = "fmi3InstantiateCoSimulation";
    struct unit blank = mouth(environment, log, logging);
    (void)resources, (void)visible, (void)earlyReturn, (void)required, (void)update;
    if (eventMode)
        return refuse(&blank, "%s: this FMU has no event mode", NAME), NULL;
    if (n > 0)
        return refuse(&blank, "%s: %u intermediate variables, this FMU has none", NAME, (unsigned)n), NULL;
    return created(&blank, NAME, name, "instantiationToken", token);
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                          fmi3Boolean logging, fmi3InstanceEnvironment environment, fmi3LogMessageCallback log)
{
    struct unit blank = mouth(environment, log, logging);
    (void)name, (void)token, (void)resources, (void)visible;
    return refuse(&blank, "fmi3InstantiateModelExchange: this FMU is for co-simulation only"), NULL;
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                               fmi3Boolean logging, fmi3InstanceEnvironment environment,
                                               fmi3LogMessageCallback log, fmi3ClockUpdateCallback update,
                                               fmi3LockPreemptionCallback lock, fmi3UnlockPreemptionCallback unlock)
{
    struct unit blank = mouth(environment, log, logging);
    (void)name, (void)token, (void)resources, (void)visible, (void)update, (void)lock, (void)unlock;
    return refuse(&blank, "fmi3InstantiateScheduledExecution: this FMU is for co-simulation only"), NULL;
}

void fmi3FreeInstance(fmi3Instance c)
{
    freed(c);
}

fmi3Status fmi3SetDebugLogging(fmi3Instance c, fmi3Boolean on, size_t n, const fmi3String categories[])
{
    struct unit *u = c;
    const enum status status = listen(u, "fmi3SetDebugLogging", on, n, categories);
    if (u != NULL)
        u->says_errors = 1;
    return (fmi3Status)status;
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance c, fmi3Boolean toleranceDefined, fmi3Float64 tolerance, fmi3Float64 start,
                                       fmi3Boolean stopDefined, fmi3Float64 stop)
{
    static const char NAME[] = "fmi3EnterInitializationMode";
    (void)toleranceDefined, (void)tolerance;
    if (set_times(c, NAME, start, stopDefined, stop) != DONE)
        return fmi3Error;
    return (fmi3Status)enter_initialization(c, NAME);
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance c)
{
    return (fmi3Status)exit_initialization(c, "fmi3ExitInitializationMode");
}

fmi3Status fmi3Terminate(fmi3Instance c)
{
    return (fmi3Status)terminate(c, "fmi3Terminate");
}

fmi3Status fmi3Reset(fmi3Instance c)
{
    return (fmi3Status)reset(c, "fmi3Reset");
}

fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 time, fmi3Float64 h, fmi3Boolean noSetPrior, fmi3Boolean *eventNeeded,
                      fmi3Boolean *terminates, fmi3Boolean *earlyReturn, fmi3Float64 *lastTime)
{
    static const char NAME[] = "fmi3DoStep";
    struct unit *u = c;
    enum status status;
    (void)noSetPrior;
    if (!allowed(u, NAME, EVERYWHERE) || !given(u, NAME, eventNeeded, terminates, 1) || !given(u, NAME, earlyReturn, lastTime, 1))
        return fmi3Error;
    status = do_step(u, NAME, time, h);
    *eventNeeded = *terminates = *earlyReturn = fmi3False;
    *lastTime = u->m.time;
    return (fmi3Status)status;
}

/* Values */

fmi3Status fmi3GetFloat64(fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3Float64 value[], size_t values)
{
    return (fmi3Status)get_reals(c, "fmi3GetFloat64", vr, n, value, values);
}

fmi3Status fmi3GetInt32(fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3Int32 value[], size_t values)
{
    return (fmi3Status)get_integers(c, "fmi3GetInt32", vr, n, value, values);
}

fmi3Status fmi3SetFloat64(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3Float64 value[], size_t values)
{
    return (fmi3Status)set_reals(c, "fmi3SetFloat64", vr, n, value, values);
}

fmi3Status fmi3SetInt32(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3Int32 value[], size_t values)
{
    return (fmi3Status)set_integers(c, "fmi3SetInt32", vr, n, value, values);
}

/* States */

fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState *state)
{
    return (fmi3Status)get_state(c, "fmi3GetFMUState", state);
}

fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState state)
{
    return (fmi3Status)set_state(c, "fmi3SetFMUState", state);
}

fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState *state)
{
    return (fmi3Status)free_state(c, "fmi3FreeFMUState", state);
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState state, size_t *size)
{
    return (fmi3Status)serialized_size(c, "fmi3SerializedFMUStateSize", state, size);
}

fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t size)
{
    return (fmi3Status)serialize(c, "fmi3SerializeFMUState", state, bytes, size);
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const fmi3Byte bytes[], size_t size, fmi3FMUState *state)
{
    return (fmi3Status)deserialize(c, "fmi3DeserializeFMUState", bytes, size, state);
}

/* The least FMU there can be: it stores what is set and multiplies once per step. Reference for the cost of a call. */
#include <stddef.h>
#include <stdlib.h>

#include "fmi2FunctionTypes.h"

#define EXPORT __attribute__((visibility("default")))
#define STUB(name) \
    EXPORT fmi2Status name(void) \
    { \
        return fmi2OK; \
    }

EXPORT fmi2Component fmi2Instantiate(void)
{
    return calloc(512, sizeof(double));
}

EXPORT void fmi2FreeInstance(fmi2Component c)
{
    free(c);
}

EXPORT fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Real value[])
{
    for (size_t i = 0; i < n; i++)
        ((double *)c)[vr[i]] = value[i];
    return fmi2OK;
}

EXPORT fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Real value[])
{
    for (size_t i = 0; i < n; i++)
        value[i] = ((double *)c)[vr[i]];
    return fmi2OK;
}

EXPORT fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real step, fmi2Boolean flag)
{
    double *value = c;
    (void)time, (void)step, (void)flag;
    value[2] = 1000.0 * value[1];
    return fmi2OK;
}

STUB(fmi2GetTypesPlatform)
STUB(fmi2GetVersion)
STUB(fmi2SetDebugLogging)
STUB(fmi2SetupExperiment)
STUB(fmi2EnterInitializationMode)
STUB(fmi2ExitInitializationMode)
STUB(fmi2Terminate)
STUB(fmi2Reset)
STUB(fmi2GetInteger)
STUB(fmi2GetBoolean)
STUB(fmi2GetString)
STUB(fmi2SetInteger)
STUB(fmi2SetBoolean)
STUB(fmi2SetString)
STUB(fmi2GetFMUstate)
STUB(fmi2SetFMUstate)
STUB(fmi2FreeFMUstate)
STUB(fmi2SerializedFMUstateSize)
STUB(fmi2SerializeFMUstate)
STUB(fmi2DeSerializeFMUstate)
STUB(fmi2GetDirectionalDerivative)
STUB(fmi2SetRealInputDerivatives)
STUB(fmi2GetRealOutputDerivatives)
STUB(fmi2CancelStep)
STUB(fmi2GetStatus)
STUB(fmi2GetRealStatus)
STUB(fmi2GetIntegerStatus)
STUB(fmi2GetBooleanStatus)
STUB(fmi2GetStringStatus)

/* What a host needs of FMI 3.0. */
#define LIKE_2(name, arguments, ...) \
    EXPORT int name arguments \
    { \
        return __VA_ARGS__; \
    }

EXPORT void *fmi3InstantiateCoSimulation(void)
{
    return calloc(512, sizeof(double));
}

LIKE_2(fmi3SetFloat64, (void *c, const unsigned vr[], size_t n, const double value[]), fmi2SetReal(c, vr, n, value))
LIKE_2(fmi3GetFloat64, (void *c, const unsigned vr[], size_t n, double value[]), fmi2GetReal(c, vr, n, value))
LIKE_2(fmi3DoStep, (void *c, double time, double step), fmi2DoStep(c, time, step, 0))
LIKE_2(fmi3EnterInitializationMode, (void), 0)
LIKE_2(fmi3ExitInitializationMode, (void), 0)

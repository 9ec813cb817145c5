/* Runs the damper's library: host LIBRARY GUID FMI oil_reference oil_level gas_reference gas_preload.
   Steps come as lines of stroke, velocity, step size; forces go out as lines. */
#include <stdio.h>
#include <stdlib.h>

#ifdef _WIN32
#include <windows.h>
#define OPEN(path) (void *)LoadLibraryA(path)
#define FIND(library, name) (void *)GetProcAddress((HMODULE)library, name)
#else
#include <dlfcn.h>
#define OPEN(path) dlopen(path, RTLD_NOW)
#define FIND(library, name) dlsym(library, name)
#endif

#include "fmi2Functions.h"
#include "fmi3Functions.h"

#define LOADED(name) name##TYPE *const name##_ = (name##TYPE *)FIND(library, #name)

static const unsigned inputs[] = {0, 1}, force = 3;

static void log2(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
                 fmi2String message, ...)
{
    (void)environment;
    fprintf(stderr, "%s: %d %s %s\n", instance, (int)status, category, message);
}

static void log3(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message)
{
    (void)environment;
    fprintf(stderr, "%d %s %s\n", (int)status, category, message);
}

static int run2(void *library, const char *guid, const unsigned state[], const double shares[])
{
    const fmi2CallbackFunctions callbacks = {log2, calloc, free, NULL, NULL};
    double value[2], h, time = 0.0;
    LOADED(fmi2Instantiate);
    LOADED(fmi2SetReal);
    LOADED(fmi2SetupExperiment);
    LOADED(fmi2EnterInitializationMode);
    LOADED(fmi2ExitInitializationMode);
    LOADED(fmi2DoStep);
    LOADED(fmi2GetReal);
    LOADED(fmi2Terminate);
    LOADED(fmi2FreeInstance);
    fmi2Component damper = fmi2Instantiate_("damper", fmi2CoSimulation, guid, "", &callbacks, fmi2False, fmi2False);
    if (damper == NULL || fmi2SetReal_(damper, state, 2, shares)
        || fmi2SetupExperiment_(damper, fmi2False, 0.0, 0.0, fmi2False, 0.0) || fmi2EnterInitializationMode_(damper)
        || fmi2ExitInitializationMode_(damper))
        return 2;
    while (scanf("%lf %lf %lf", &value[0], &value[1], &h) == 3) {
        if (fmi2SetReal_(damper, inputs, 2, value) || fmi2DoStep_(damper, time, h, fmi2True)
            || fmi2GetReal_(damper, &force, 1, value))
            return 3;
        printf("%.17g\n", value[0]);
        time += h;
    }
    if (fmi2Terminate_(damper))
        return 4;
    fmi2FreeInstance_(damper);
    return 0;
}

static int run3(void *library, const char *token, const unsigned state[], const double shares[])
{
    double value[2], h, reached, time = 0.0;
    bool event, ended, early;
    LOADED(fmi3InstantiateCoSimulation);
    LOADED(fmi3SetFloat64);
    LOADED(fmi3EnterInitializationMode);
    LOADED(fmi3ExitInitializationMode);
    LOADED(fmi3DoStep);
    LOADED(fmi3GetFloat64);
    LOADED(fmi3Terminate);
    LOADED(fmi3FreeInstance);
    fmi3Instance damper = fmi3InstantiateCoSimulation_("damper", token, NULL, fmi3False, fmi3False, fmi3False, fmi3False,
                                                       NULL, 0, NULL, log3, NULL);
    if (damper == NULL || fmi3SetFloat64_(damper, state, 2, shares, 2)
        || fmi3EnterInitializationMode_(damper, fmi3False, 0.0, 0.0, fmi3False, 0.0) || fmi3ExitInitializationMode_(damper))
        return 2;
    while (scanf("%lf %lf %lf", &value[0], &value[1], &h) == 3) {
        if (fmi3SetFloat64_(damper, inputs, 2, value, 2)
            || fmi3DoStep_(damper, time, h, fmi3True, &event, &ended, &early, &reached)
            || fmi3GetFloat64_(damper, &force, 1, value, 1))
            return 3;
        printf("%.17g\n", value[0]);
        time += h;
    }
    if (fmi3Terminate_(damper))
        return 4;
    fmi3FreeInstance_(damper);
    return 0;
}

int main(int count, char **argument)
{
    void *library = count == 8 ? OPEN(argument[1]) : NULL;
    if (library == NULL) {
        fprintf(stderr, "not loaded\n");
        return 1;
    }
    const unsigned state[] = {(unsigned)atoi(argument[4]), (unsigned)atoi(argument[6])};
    const double shares[] = {atof(argument[5]), atof(argument[7])};
    return (atoi(argument[3]) == 3 ? run3 : run2)(library, argument[2], state, shares);
}

/* Runs the damper's library: host LIBRARY GUID oil_reference oil_level gas_reference gas_preload.
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

#define LOADED(name) name##TYPE *const name##_ = (name##TYPE *)FIND(library, #name)

static void log_line(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
                     fmi2String message, ...)
{
    (void)environment;
    fprintf(stderr, "%s: %d %s %s\n", instance, (int)status, category, message);
}

int main(int count, char **argument)
{
    const fmi2CallbackFunctions callbacks = {log_line, calloc, free, NULL, NULL};
    const fmi2ValueReference inputs[] = {0, 1}, force = 2;
    double value[2], h, time = 0.0;
    void *library = count == 7 ? OPEN(argument[1]) : NULL;
    if (library == NULL) {
        fprintf(stderr, "not loaded\n");
        return 1;
    }
    LOADED(fmi2Instantiate);
    LOADED(fmi2SetReal);
    LOADED(fmi2SetInteger);
    LOADED(fmi2SetupExperiment);
    LOADED(fmi2EnterInitializationMode);
    LOADED(fmi2ExitInitializationMode);
    LOADED(fmi2DoStep);
    LOADED(fmi2GetReal);
    LOADED(fmi2Terminate);
    LOADED(fmi2FreeInstance);
    const fmi2ValueReference oil = (fmi2ValueReference)atoi(argument[3]), gas = (fmi2ValueReference)atoi(argument[5]);
    const fmi2Real oil_level = atof(argument[4]);
    const fmi2Integer gas_preload = atoi(argument[6]);
    fmi2Component damper = fmi2Instantiate_("damper", fmi2CoSimulation, argument[2], "", &callbacks, fmi2False, fmi2False);
    if (damper == NULL || fmi2SetReal_(damper, &oil, 1, &oil_level) || fmi2SetInteger_(damper, &gas, 1, &gas_preload)
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

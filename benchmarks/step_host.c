/* Time of a set, step and get: step_host LIBRARY GUID FMI STEP STEPS INSTANCES INPUT INPUT OUTPUT (value references).

   The instances take turns. Prints ns per step and bytes of memory per instance. */
#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "fmi2Functions.h"
#include "fmi3Functions.h"

#define FUNCTION(name) name##TYPE *name##_ = (name##TYPE *)find(library, #name)
#define MOST 1000
#define PERIOD 4000 /* steps of an oscillation */

static void *find(void *library, const char *name)
{
    void *function = dlsym(library, name);
    if (function == NULL)
        fprintf(stderr, "%s is missing\n", name), exit(1);
    return function;
}

static void silent2(fmi2ComponentEnvironment e, fmi2String i, fmi2Status s, fmi2String c, fmi2String m, ...)
{
    (void)e, (void)i, (void)s, (void)c, (void)m;
}

static void silent3(fmi3InstanceEnvironment e, fmi3Status s, fmi3String c, fmi3String m)
{
    (void)e, (void)s, (void)c, (void)m;
}

static long resident(void)
{
    long all = 0, used = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (file == NULL || fscanf(file, "%ld %ld", &all, &used) != 2)
        exit(1);
    fclose(file);
    return used * sysconf(_SC_PAGESIZE);
}

/* Time of the processor [s]: other programs of the machine do not count. */
static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

int main(int n, char **argument)
{
    static const fmi2CallbackFunctions functions = {silent2, calloc, free, NULL, NULL};
    static void *unit[MOST];
    static double moved[PERIOD][2];
    void *library = n == 10 ? dlopen(argument[1], RTLD_NOW) : NULL;
    const int new = n == 10 && atoi(argument[3]) == 3, instances = n == 10 ? atoi(argument[6]) : 0;
    if (library == NULL || instances < 1 || instances > MOST)
        return fprintf(stderr, "%s\n", n == 10 ? dlerror() : "arguments"), 1;
    const double h = atof(argument[4]);
    const long steps = atol(argument[5]);
    const unsigned in[] = {(unsigned)atoi(argument[7]), (unsigned)atoi(argument[8])}, out = (unsigned)atoi(argument[9]);
    const long before = resident();
    double value, total = 0.0, begun = 0.0;
    for (long k = 0; k < PERIOD; k++) {
        moved[k][0] = 0.03 * sin(6.283185307179586 * (double)k / PERIOD);
        moved[k][1] = 0.03 * (sin(6.283185307179586 * (double)(k + 1) / PERIOD) - moved[k][0] / 0.03) / h;
    }
    if (new) {
        FUNCTION(fmi3InstantiateCoSimulation);
        FUNCTION(fmi3EnterInitializationMode);
        FUNCTION(fmi3ExitInitializationMode);
        FUNCTION(fmi3SetFloat64);
        FUNCTION(fmi3DoStep);
        FUNCTION(fmi3GetFloat64);
        bool event, ended, early;
        for (int i = 0; i < instances; i++) {
            unit[i] = fmi3InstantiateCoSimulation_("unit", argument[2], NULL, 0, 0, 0, 0, NULL, 0, NULL, silent3, NULL);
            if (unit[i] == NULL || fmi3EnterInitializationMode_(unit[i], 0, 0.0, 0.0, 0, 0.0) || fmi3ExitInitializationMode_(unit[i]))
                return 2;
        }
        for (long k = -PERIOD; k < steps; k++) {
            if (k == 0)
                begun = now();
            void *c = unit[(k + PERIOD) / PERIOD % instances];
            double at = (double)((k + PERIOD) / PERIOD / instances * PERIOD + (k + PERIOD) % PERIOD) * h;
            if (fmi3SetFloat64_(c, in, 2, moved[(k + PERIOD) % PERIOD], 2) > 1 || fmi3DoStep_(c, at, h, 1, &event, &ended, &early, &value) > 1
                || fmi3GetFloat64_(c, &out, 1, &value, 1) > 1)
                return 3;
            total += value;
        }
    } else {
        FUNCTION(fmi2Instantiate);
        FUNCTION(fmi2SetupExperiment);
        FUNCTION(fmi2EnterInitializationMode);
        FUNCTION(fmi2ExitInitializationMode);
        FUNCTION(fmi2SetReal);
        FUNCTION(fmi2DoStep);
        FUNCTION(fmi2GetReal);
        for (int i = 0; i < instances; i++) {
            unit[i] = fmi2Instantiate_("unit", fmi2CoSimulation, argument[2], "", &functions, 0, 0);
            if (unit[i] == NULL || fmi2SetupExperiment_(unit[i], 0, 0.0, 0.0, 0, 0.0) || fmi2EnterInitializationMode_(unit[i])
                || fmi2ExitInitializationMode_(unit[i]))
                return 2;
        }
        for (long k = -PERIOD; k < steps; k++) {
            if (k == 0)
                begun = now();
            void *c = unit[(k + PERIOD) / PERIOD % instances];
            double at = (double)((k + PERIOD) / PERIOD / instances * PERIOD + (k + PERIOD) % PERIOD) * h;
            if (fmi2SetReal_(c, in, 2, moved[(k + PERIOD) % PERIOD]) > 1 || fmi2DoStep_(c, at, h, 1) > 1 || fmi2GetReal_(c, &out, 1, &value) > 1)
                return 3;
            total += value;
        }
    }
    printf("%.2f %.0f\n", 1e9 * (now() - begun) / (double)steps, (double)(resident() - before) / instances);
    return total - total == 0.0 ? 0 : 4;
}

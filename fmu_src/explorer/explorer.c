/* The unit of the FMU for a page: its FMI functions as they are, and loops over them, so that a record crosses the border
   between page and module once. The damper is reached through the FMI functions alone. */
#define FMI2_FUNCTION_PREFIX /* as in a shared library */
#include "fmi2.c"
#include "quarter_car.h"

#define EXPORTED(name) __attribute__((export_name(#name)))

enum { STROKE, VELOCITY, TEMPERATURE, FORCE }; /* value references, the first of the table of variables */

static char message[512];

static void remember(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category,
                     fmi2String text, ...)
{
    (void)environment, (void)name, (void)category;
    if (status > fmi2Warning)
        snprintf(message, sizeof message, "%s", text);
}

/* The latest message of a unit that refused something. */
EXPORTED(said) const char *said(void)
{
    return message;
}

EXPORTED(reserve_memory) void *reserve_memory(size_t size)
{
    return malloc(size);
}

EXPORTED(release_memory) void release_memory(void *memory)
{
    free(memory);
}

/* A new unit; its parameters are those of the damper that it was compiled with until they are set. */
EXPORTED(open_unit) fmi2Component open_unit(void)
{
    static const fmi2CallbackFunctions functions = {remember, calloc, free, NULL, NULL};
    return fmi2Instantiate("explorer", fmi2CoSimulation, VALUES.guid, "", &functions, fmi2False, fmi2True);
}

/* At rest at a stroke, ready to step. */
EXPORTED(start_unit) int start_unit(fmi2Component c, double time, double stroke)
{
    const fmi2ValueReference input = STROKE;
    return fmi2SetupExperiment(c, fmi2False, 0.0, time, fmi2False, 0.0) <= fmi2Warning
           && fmi2SetReal(c, &input, 1, &stroke) <= fmi2Warning && fmi2EnterInitializationMode(c) <= fmi2Warning
           && fmi2ExitInitializationMode(c) <= fmi2Warning;
}

static int step(fmi2Component c, double time, double h, double stroke, double velocity, double rate)
{
    const fmi2ValueReference inputs[] = {STROKE, VELOCITY};
    const fmi2Integer first = 1;
    const double values[] = {stroke, velocity};
    if (fmi2SetReal(c, inputs, 2, values) > fmi2Warning)
        return 0;
    if (rate != 0.0 && fmi2SetRealInputDerivatives(c, &inputs[1], 1, &first, &rate) > fmi2Warning)
        return 0;
    return fmi2DoStep(c, time, h, fmi2True) <= fmi2Warning;
}

/* The wanted outputs as sample `i` of columns of `n`; nothing without `out`. */
static int noted(fmi2Component c, int i, int n, const fmi2ValueReference *wanted, int columns, double *out)
{
    for (int k = 0; out != NULL && k < columns; k++)
        if (fmi2GetReal(c, &wanted[k], 1, &out[(size_t)k * n + i]) > fmi2Warning)
            return 0;
    return 1;
}

/* A record of `n` samples: times [s], strokes [m], velocities [m/s], which change evenly between samples; without them the
   velocity of a step is the mean one. Returns the number of samples done. */
EXPORTED(run_record) int run_record(fmi2Component c, int n, const double *time, const double *stroke, const double *velocity,
                                    const fmi2ValueReference *wanted, int columns, double *out)
{
    if (n < 1 || !noted(c, 0, n, wanted, columns, out))
        return 0;
    for (int i = 0; i + 1 < n; i++) {
        const double h = time[i + 1] - time[i];
        const double v = velocity ? velocity[i] : (stroke[i + 1] - stroke[i]) / h;
        const double rate = velocity && h > 0.0 ? (velocity[i + 1] - v) / h : 0.0;
        if (!step(c, time[i], h, stroke[i], v, rate) || !noted(c, i + 1, n, wanted, columns, out))
            return i + 1;
    }
    return n;
}

/* The quarter car with the unit in the loop, step by step as `vehicle/loops.py`: road heights [m] and rates [m/s] every `h`
   [s] from `time` on. `out` gets the wanted outputs, then columns of stroke, velocity and wheel load. Returns the number of
   samples done. */
EXPORTED(run_drive) int run_drive(fmi2Component c, struct quarter_Car *car, int n, double time, double h, const double *road,
                                  const double *rates, const fmi2ValueReference *wanted, int columns, double *out)
{
    const fmi2ValueReference output = FORCE;
    struct quarter_Motion motion = {0};
    double *motions = out + (size_t)columns * n;
    double force, earlier;
    if (fmi2GetReal(c, &output, 1, &force) > fmi2Warning)
        return 0;
    earlier = force;
    for (int i = 0; i < n; i++) {
        const double stroke = quarter_damper_stroke(car, &motion);
        double velocity;
        if (!noted(c, i, n, wanted, columns, out))
            return i;
        motions[i] = stroke;
        motions[2 * (size_t)n + i] = quarter_leapfrog_step(car, &motion, road[i], rates[i], 1.5 * force - 0.5 * earlier, 0.0, h);
        velocity = quarter_damper_velocity(car, &motion);
        motions[(size_t)n + i] = velocity;
        earlier = force;
        if (!step(c, time + i * h, h, stroke, velocity, 0.0) || fmi2GetReal(c, &output, 1, &force) > fmi2Warning)
            return i;
    }
    return n;
}

EXPORTED(static_load) double static_load(struct quarter_Car *car)
{
    return quarter_static_load(car);
}

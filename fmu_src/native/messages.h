/* Generated from what the interpreter says: texts and limits of the checks. */
#ifndef MESSAGES_H
#define MESSAGES_H

#define SAY_OUTSIDE "%s = %g%s: must be a number from %g to %g%s"
#define SAY_NO_VARIABLE "%s: no %s variable has the value reference %d"
#define SAY_NOT_SETTABLE "%s: an output cannot be set"
#define SAY_FIXED "%s: fixed, cannot change after the initialization"
#define SAY_NOT_NOW "%s: not allowed %s"
#define SAY_MISTIMED "communication point = %.10g s: the last step ended at %.10g s"
#define SAY_BEYOND_STOP "communication step = %g s at %.10g s: beyond the stop time %.10g s"
#define SAY_NO_START "the start could not be computed; please report this parameter set"
#define SAY_NO_STEP "time %g s: the step could not be computed; please report this parameter set"
#define SAY_PARTED "time %g s: %s went %g m, %s led %g m in the same time, and the two parted by %g m; check sign, unit and connection of %s"
#define SAY_BEYOND_LAW "temperature = %g K: the law of this damper holds from %g to %g K; beyond it fluid force and friction are those of its end"
#define SAY_LONG_STEP "time %g s: communication step = %g s: with a wheel in the loop at most %g s are safe; in longer steps the force comes late and an intact damper looks worn. A motion that does not answer to the force, as one from a record, may have them"
#define SAY_NO_STATE "%s: the bytes are not an FMU state"
#define SAY_OTHER_STATE "%s: the state belongs to another FMU"
#define SAY_DAMAGED_STATE "%s: the state is damaged"

/* By the numbers of the rules in kernel.h. */
static const char *const RULE[] = {
    "",
    "fv.rebound: velocity %d = %g m/s must be above %g m/s",
    "fv.rebound: velocity %d = %g m/s must be above the velocity before it, %g m/s",
    "fv.rebound: not monotone, force %d = %g N must be at least the force before it, %g N",
    "fv.compression: velocity %d = %g m/s must be above %g m/s",
    "fv.compression: velocity %d = %g m/s must be above the velocity before it, %g m/s",
    "fv.compression: not monotone, force %d = %g N must be at least the force before it, %g N",
    "geometry.D_PR = %g m: must be below geometry.D_li = %g m",
    "geometry.D_li = %g m: must be below geometry.D_la = %g m",
    "geometry.D_la = %g m: must be below geometry.D_a = %g m",
    "geometry.dead_length = %g m: must be below geometry.h_l = %g m",
    "geometry.stroke_max = %g m: must be below %g m, half of h_l - dead_length",
    "geometry.V_oil = %g m3: must be at least %g m3, or the intact damper draws gas in rebound",
    "geometry.V_oil = %g m3: must be at most %g m3, the room at full compression",
    "gas_spring.c_gas = %g N/m: must be below %g N/m, or a polytropic gas has no room left at full compression",
    "gas_spring.c_gas_lost = %g N/m: must be below %g N/m, or a polytropic gas has no room left at full compression",
    "temperature.T_cold = %g K: must be below temperature.T_curve = %g K",
    "temperature.T_hot = %g K: must be above temperature.T_curve = %g K",
};

static const char *const MODE[] = {"before the initialization", "in the initialization mode", "between the steps", "after the end"};

#define LONGEST 1000000000000.0
#define SAFE_STEP 0.002
#define LOWEST_VELOCITY -20.0
#define HIGHEST_VELOCITY 20.0

#endif

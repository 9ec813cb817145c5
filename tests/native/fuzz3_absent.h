/* A random call of a function that the FMU has only to refuse it, with arguments of no use. */
#ifndef FUZZ3_ABSENT_H
#define FUZZ3_ABSENT_H

static fmi3Status absent(fmi3Instance c)
{
    const fmi3ValueReference *r = drawn(2) ? output : NULL;
    const size_t n = drawn(3), m = drawn(3);
    double reals[4] = {0.0}, *d = drawn(2) ? reals : NULL;
    fmi3Boolean flag;
    size_t count;
#define VALUES(Type)                                                    \
    {                                                                   \
        fmi3##Type value[4] = {0};                                      \
        return drawn(2) ? fmi3Get##Type(c, r, n, drawn(2) ? value : NULL, m) : fmi3Set##Type(c, r, n, value, m); \
    }
    switch (drawn(38)) {
    case 0: VALUES(Float32)
    case 1: VALUES(Int8)
    case 2: VALUES(UInt8)
    case 3: VALUES(Int16)
    case 4: VALUES(UInt16)
    case 5: VALUES(UInt32)
    case 6: VALUES(Int64)
    case 7: VALUES(UInt64)
    case 8: VALUES(Boolean)
    case 9: VALUES(String)
    case 10: return fmi3GetBinary(c, r, n, NULL, NULL, m);
    case 11: return fmi3SetBinary(c, r, n, NULL, NULL, m);
    case 12: return fmi3GetClock(c, r, n, NULL);
    case 13: return fmi3SetClock(c, r, n, NULL);
    case 14: return fmi3GetNumberOfVariableDependencies(c, 2, &count);
    case 15: return fmi3GetVariableDependencies(c, 2, NULL, NULL, NULL, NULL, n);
    case 16: return fmi3GetDirectionalDerivative(c, r, n, r, m, d, m, d, n);
    case 17: return fmi3GetAdjointDerivative(c, r, n, r, m, d, m, d, n);
    case 18: return fmi3EnterConfigurationMode(c);
    case 19: return fmi3ExitConfigurationMode(c);
    case 20: return fmi3GetIntervalDecimal(c, r, n, d, NULL);
    case 21: return fmi3GetIntervalFraction(c, r, n, NULL, NULL, NULL);
    case 22: return fmi3GetShiftDecimal(c, r, n, d);
    case 23: return fmi3GetShiftFraction(c, r, n, NULL, NULL);
    case 24: return fmi3SetIntervalDecimal(c, r, n, d);
    case 25: return fmi3SetIntervalFraction(c, r, n, NULL, NULL);
    case 26: return fmi3SetShiftDecimal(c, r, n, d);
    case 27: return fmi3SetShiftFraction(c, r, n, NULL, NULL);
    case 28: return drawn(2) ? fmi3EvaluateDiscreteStates(c) : fmi3EnterEventMode(c);
    case 29: return fmi3UpdateDiscreteStates(c, &flag, &flag, &flag, &flag, &flag, reals);
    case 30: return drawn(2) ? fmi3EnterContinuousTimeMode(c) : fmi3EnterStepMode(c);
    case 31: return fmi3CompletedIntegratorStep(c, fmi3True, &flag, &flag);
    case 32: return drawn(2) ? fmi3SetTime(c, any_number()) : fmi3SetContinuousStates(c, d, n);
    case 33: return drawn(2) ? fmi3GetContinuousStateDerivatives(c, d, n) : fmi3GetContinuousStates(c, d, n);
    case 34: return drawn(2) ? fmi3GetEventIndicators(c, d, n) : fmi3GetNominalsOfContinuousStates(c, d, n);
    case 35: return drawn(2) ? fmi3GetNumberOfEventIndicators(c, &count) : fmi3GetNumberOfContinuousStates(c, &count);
    case 36: return fmi3GetOutputDerivatives(c, r, n, NULL, d, m);
    default: return fmi3ActivateModelPartition(c, 2, any_number());
    }
}

#endif

/* The functions of FMI 3.0 for what this FMU has none of. Importers load them all, so each is there and refuses. */
#ifndef FMI3_ABSENT_H
#define FMI3_ABSENT_H

#define NO_VALUES(Type)                                                                                                   \
    fmi3Status fmi3Get##Type(fmi3Instance c, const fmi3ValueReference vr[], size_t n, fmi3##Type value[], size_t values)   \
    {                                                                                                                     \
        (void)vr, (void)value, (void)values;                                                                              \
        return (fmi3Status)none(c, "fmi3Get" #Type, #Type " variable", n);                                                \
    }                                                                                                                     \
    fmi3Status fmi3Set##Type(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3##Type value[],            \
                             size_t values)                                                                               \
    {                                                                                                                     \
        (void)vr, (void)value, (void)values;                                                                              \
        return (fmi3Status)none(c, "fmi3Set" #Type, #Type " variable", n);                                                \
    }
NO_VALUES(Float32)
NO_VALUES(Int8)
NO_VALUES(UInt8)
NO_VALUES(Int16)
NO_VALUES(UInt16)
NO_VALUES(UInt32)
NO_VALUES(Int64)
NO_VALUES(UInt64)
NO_VALUES(Boolean)
NO_VALUES(String)

/* Arguments are named by their place. */
#define REFUSES(what) return c ? (fmi3Status)refuse((struct unit *)c, "%s: this FMU has no " what, function) : fmi3Error
#define ABSENT(name, what)                       \
    fmi3Status name(fmi3Instance c)              \
    {                                            \
        static const char function[] = #name;    \
        REFUSES(what);                           \
    }
#define ABSENT_1(name, what, A)                  \
    fmi3Status name(fmi3Instance c, A a)         \
    {                                            \
        static const char function[] = #name;    \
        (void)a;                                 \
        REFUSES(what);                           \
    }
#define ABSENT_2(name, what, A, B)               \
    fmi3Status name(fmi3Instance c, A a, B b)    \
    {                                            \
        static const char function[] = #name;    \
        (void)a, (void)b;                        \
        REFUSES(what);                           \
    }
/* After the references and their number. */
#define ABSENT_OF(name, what, A)                                                       \
    fmi3Status name(fmi3Instance c, const fmi3ValueReference vr[], size_t n, A a)      \
    {                                                                                  \
        (void)vr, (void)a;                                                             \
        return (fmi3Status)none(c, #name, what, n);                                    \
    }
#define ABSENT_OF_2(name, what, A, B)                                                  \
    fmi3Status name(fmi3Instance c, const fmi3ValueReference vr[], size_t n, A a, B b) \
    {                                                                                  \
        (void)vr, (void)a, (void)b;                                                    \
        return (fmi3Status)none(c, #name, what, n);                                    \
    }
#define ABSENT_OF_3(name, what, A, B, D)                                                    \
    fmi3Status name(fmi3Instance c, const fmi3ValueReference vr[], size_t n, A a, B b, D d) \
    {                                                                                       \
        (void)vr, (void)a, (void)b, (void)d;                                                \
        return (fmi3Status)none(c, #name, what, n);                                         \
    }
#define NO_DERIVATIVES(name, what)                                                                                           \
    fmi3Status name(fmi3Instance c, const fmi3ValueReference unknown[], size_t n, const fmi3ValueReference known[], size_t k, \
                    const fmi3Float64 seed[], size_t seeds, fmi3Float64 sensitivity[], size_t sensitivities)                 \
    {                                                                                                                        \
        (void)unknown, (void)known, (void)k, (void)seed, (void)seeds, (void)sensitivity, (void)sensitivities;                \
        return (fmi3Status)none(c, #name, what, n);                                                                          \
    }

ABSENT_OF_3(fmi3GetBinary, "Binary variable", size_t *, fmi3Binary *, size_t)
ABSENT_OF_3(fmi3SetBinary, "Binary variable", const size_t *, const fmi3Binary *, size_t)
ABSENT_OF_3(fmi3GetOutputDerivatives, "output derivative", const fmi3Int32 *, fmi3Float64 *, size_t)
NO_DERIVATIVES(fmi3GetDirectionalDerivative, "directional derivative")
NO_DERIVATIVES(fmi3GetAdjointDerivative, "adjoint derivative")

ABSENT_OF(fmi3GetClock, "clock", fmi3Clock *)
ABSENT_OF(fmi3SetClock, "clock", const fmi3Clock *)
ABSENT_OF_2(fmi3GetIntervalDecimal, "clock", fmi3Float64 *, fmi3IntervalQualifier *)
ABSENT_OF_3(fmi3GetIntervalFraction, "clock", fmi3UInt64 *, fmi3UInt64 *, fmi3IntervalQualifier *)
ABSENT_OF(fmi3GetShiftDecimal, "clock", fmi3Float64 *)
ABSENT_OF_2(fmi3GetShiftFraction, "clock", fmi3UInt64 *, fmi3UInt64 *)
ABSENT_OF(fmi3SetIntervalDecimal, "clock", const fmi3Float64 *)
ABSENT_OF_2(fmi3SetIntervalFraction, "clock", const fmi3UInt64 *, const fmi3UInt64 *)
ABSENT_OF(fmi3SetShiftDecimal, "clock", const fmi3Float64 *)
ABSENT_OF_2(fmi3SetShiftFraction, "clock", const fmi3UInt64 *, const fmi3UInt64 *)
ABSENT_2(fmi3ActivateModelPartition, "clock", fmi3ValueReference, fmi3Float64)

ABSENT(fmi3EnterConfigurationMode, "structural parameter")
ABSENT(fmi3ExitConfigurationMode, "structural parameter")
ABSENT(fmi3EnterEventMode, "event mode")
ABSENT(fmi3EnterStepMode, "event mode")
ABSENT(fmi3EvaluateDiscreteStates, "event mode")
ABSENT_2(fmi3GetNumberOfVariableDependencies, "dependency of single elements", fmi3ValueReference, size_t *)

ABSENT(fmi3EnterContinuousTimeMode, "model exchange")
ABSENT_1(fmi3SetTime, "model exchange", fmi3Float64)
ABSENT_2(fmi3SetContinuousStates, "model exchange", const fmi3Float64 *, size_t)
ABSENT_2(fmi3GetContinuousStateDerivatives, "model exchange", fmi3Float64 *, size_t)
ABSENT_2(fmi3GetEventIndicators, "model exchange", fmi3Float64 *, size_t)
ABSENT_2(fmi3GetContinuousStates, "model exchange", fmi3Float64 *, size_t)
ABSENT_2(fmi3GetNominalsOfContinuousStates, "model exchange", fmi3Float64 *, size_t)
ABSENT_1(fmi3GetNumberOfEventIndicators, "model exchange", size_t *)
ABSENT_1(fmi3GetNumberOfContinuousStates, "model exchange", size_t *)

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance c, fmi3Boolean noSetPrior, fmi3Boolean *event, fmi3Boolean *terminates)
{
    static const char function[] = "fmi3CompletedIntegratorStep";
    (void)noSetPrior, (void)event, (void)terminates;
    REFUSES("model exchange");
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance c, fmi3Boolean *again, fmi3Boolean *terminates, fmi3Boolean *nominals,
                                    fmi3Boolean *states, fmi3Boolean *next, fmi3Float64 *nextTime)
{
    static const char function[] = "fmi3UpdateDiscreteStates";
    (void)again, (void)terminates, (void)nominals, (void)states, (void)next, (void)nextTime;
    REFUSES("event mode");
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance c, fmi3ValueReference dependent, size_t element[],
                                       fmi3ValueReference independents[], size_t elements[], fmi3DependencyKind kinds[],
                                       size_t n)
{
    static const char function[] = "fmi3GetVariableDependencies";
    (void)dependent, (void)element, (void)independents, (void)elements, (void)kinds, (void)n;
    REFUSES("dependency of single elements");
}

#endif

/* What a damper remembers. */
#ifndef MEMORY_H
#define MEMORY_H

struct parameters {
    struct kernel_Parameters p;
};

struct model {
    struct kernel_Derived d;
    struct kernel_State s;
    struct kernel_Flow f;
    struct kernel_Outputs out;
    struct kernel_Agreement a;
    double stroke, velocity, temperature;
    double limit; /* [m] largest stroke to each side */
    int64_t beyond_law; /* whether a temperature beyond the law of the damper was warned of */
};

/* The input whose derivative counts; that of the stroke is the velocity. */
#define DERIVED_INPUT offsetof(struct memory, now.velocity)

#endif

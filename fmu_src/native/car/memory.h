/* What a car remembers; wheels in the order front left, front right, rear left, rear right. */
#ifndef MEMORY_H
#define MEMORY_H

struct parameters {
    struct kernel_Body body;
    struct kernel_Wheel front, rear;
    struct kernel_Brakes brakes;
    double speed; /* [m/s] at the start */
};

struct model {
    struct kernel_Body c;
    struct kernel_Wheel k[4];
    struct kernel_BodyMotion b;
    struct kernel_WheelMotion w[4];
    struct kernel_Course t;
    struct kernel_Agreement a[4]; /* of the road under each wheel and its rate */
    struct kernel_DriverInputs driver;
    struct kernel_WheelInputs given[4];
    struct kernel_BodyOutputs out;
    struct kernel_WheelOutputs wheel[4];
};

/* The rates of the road are inputs themselves, and forces are carried on: no derivative counts. */
#define DERIVED_INPUT sizeof(struct memory)

#endif

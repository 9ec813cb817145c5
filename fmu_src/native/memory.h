/* What a damper remembers. */
#ifndef MEMORY_H
#define MEMORY_H

/* The parameters with the memory of their F-v curve: velocities and forces of rebound, of compression. */
struct parameters {
    struct kernel_Parameters p;
    double fv[4][FV_POINTS];
};

struct model {
    struct kernel_Derived d;
    struct kernel_State s;
    struct kernel_Flow f;
    struct kernel_Outputs out;
    struct kernel_Agreement a;
    double stroke, velocity;
    double limit; /* [m] largest stroke to each side */
};

/* The input whose derivative counts; that of the stroke is the velocity. */
#define DERIVED_INPUT offsetof(struct memory, now.velocity)

/* Point the parameters to the memory of their own curve, as is needed after a copy. */
static void bind(struct parameters *of)
{
    of->p.v_re.data = of->fv[0];
    of->p.F_re.data = of->fv[1];
    of->p.v_co.data = of->fv[2];
    of->p.F_co.data = of->fv[3];
}

/* Addresses mean nothing elsewhere. */
static void unbind(struct parameters *of)
{
    of->p.v_re.data = of->p.F_re.data = of->p.v_co.data = of->p.F_co.data = NULL;
}

#endif

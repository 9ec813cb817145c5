/* What FMI 3.0 calls variables: an array is one, and the time is the last. */
#ifndef VERSION_H
#define VERSION_H

#define ARRAYS 1
static const char *const KIND[] = {"Float64", "Int32"};

#endif

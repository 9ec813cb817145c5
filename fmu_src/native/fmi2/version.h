/* What FMI 2.0 calls variables: each element of an array is one of its own, and the time is none. */
#ifndef VERSION_H
#define VERSION_H

#define ARRAYS 0
static const char *const KIND[] = {"Real", "Integer"};

#endif

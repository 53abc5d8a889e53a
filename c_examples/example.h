/* What the examples share: options of the command line, the CSV file, and a check by marching. */

#ifndef EXAMPLE_H
#define EXAMPLE_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <periodyn.h>

/* Leaves for `done` with a message if a call fails. */
#define TRY(call)                                                                                  \
    do {                                                                                           \
        if ((call) != PDN_OK) {                                                                    \
            char message[512];                                                                     \
            pdn_last_error(message, sizeof message);                                               \
            fprintf(stderr, "%s\n  failed: %s\n", #call, message);                                 \
            goto done;                                                                             \
        }                                                                                          \
    } while (0)

/* The text after option `name`, or `fallback`. */
static inline const char *option_text(int argc, char **argv, const char *name, const char *fallback)
{
    for (int i = 1; i + 1 < argc; i += 2) {
        if (strcmp(argv[i], name) == 0) {
            return argv[i + 1];
        }
    }
    return fallback;
}

/* The positive number after option `name`, or `fallback`; ends the program if it is none. */
static inline size_t option_count(int argc, char **argv, const char *name, size_t fallback)
{
    const char *text = option_text(argc, argv, name, NULL);
    char *end = NULL;
    const long value = text ? strtol(text, &end, 10) : (long)fallback;
    if (text && (value <= 0 || *end != '\0')) {
        fprintf(stderr, "%s: expected a positive whole number, got %s\n", name, text);
        exit(2);
    }
    return (size_t)value;
}

/* The number after option `name`, or `fallback`; ends the program if it is none. */
static inline double option_number(int argc, char **argv, const char *name, double fallback)
{
    const char *text = option_text(argc, argv, name, NULL);
    char *end = NULL;
    const double value = text ? strtod(text, &end) : fallback;
    if (text && (end == text || *end != '\0')) {
        fprintf(stderr, "%s: expected a number, got %s\n", name, text);
        exit(2);
    }
    return value;
}

/* Ends the program unless each argument is one of `names` (separated by spaces) with its value. */
static inline void check_options(int argc, char **argv, const char *names)
{
    for (int i = 1; i < argc; i += 2) {
        const char *found = strstr(names, argv[i]);
        const size_t length = strlen(argv[i]);
        if (!found || (found[length] != ' ' && found[length] != '\0') || i + 1 == argc) {
            fprintf(stderr, "usage: %s [OPTION VALUE]...\noptions: %s\n", argv[0], names);
            exit(2);
        }
    }
}

/* Opens the file after option --out; NULL without it. Ends the program if it cannot be written. */
static inline FILE *open_out(int argc, char **argv)
{
    const char *name = option_text(argc, argv, "--out", NULL);
    FILE *file = name ? fopen(name, "w") : NULL;
    if (name && !file) {
        perror(name);
        exit(2);
    }
    return file;
}

/* Largest distance of a node in two solutions at 100 times of a period. */
static inline int largest_distance(const pdn_solution *a, const pdn_solution *b, int32_t node,
                                   double period, double *out)
{
    double t[100], x[100][3], y[100][3];
    *out = 0;
    for (int i = 0; i < 100; ++i) {
        t[i] = period * i / 99;
    }
    TRY(pdn_solution_sample(a, PDN_QUANTITY(PDN_NODE_POSITION, node, PDN_ALL_COMPONENTS), t, 100,
                            x[0]));
    TRY(pdn_solution_sample(b, PDN_QUANTITY(PDN_NODE_POSITION, node, PDN_ALL_COMPONENTS), t, 100,
                            y[0]));
    for (int i = 0; i < 100; ++i) {
        const double d[3] = {x[i][0] - y[i][0], x[i][1] - y[i][1], x[i][2] - y[i][2]};
        *out = fmax(*out, sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]));
    }
    return 0;
done:
    return 1;
}

/* Marches a period from a solution, in `steps` and in twice as many steps: how far a node gets from
 * its periodic motion, and how far the two marches, of second order, are in error by their
 * difference.
 */
static inline int check_by_march(const pdn_model *model, const pdn_solution *solution, int32_t node,
                                 double period, size_t steps)
{
    int failed = 1;
    pdn_solution *march[2] = {NULL, NULL};
    double away, apart;
    pdn_march_options options;
    PDN_INIT(pdn_march_options, &options);
    options.initial = solution;
    options.duration = options.period = period;
    for (int i = 0; i < 2; ++i) {
        options.steps_per_period = (size_t)(i + 1) * steps;
        TRY(pdn_solve_march(model, &options, &march[i]));
    }
    if (largest_distance(solution, march[1], node, period, &away) != 0 ||
        largest_distance(march[0], march[1], node, period, &apart) != 0) {
        goto done;
    }
    printf("Marched for a period in %d steps, node %d gets %.1e away; the march is right to %.1e\n",
           (int)(2 * steps), (int)(node - PDN_FIRST_NODE), away, apart / 3);
    failed = away > apart;
done:
    pdn_solution_free(march[0]);
    pdn_solution_free(march[1]);
    return failed;
}

#endif

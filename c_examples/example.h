/* What the examples share, none of it about Periodyn: options of the command line, and the CSV file. */

#ifndef EXAMPLE_H
#define EXAMPLE_H

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

#endif

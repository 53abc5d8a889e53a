/* Checks that hold in every build type, unlike assert. */
#ifndef PDN_TEST_CHECK_H
#define PDN_TEST_CHECK_H

#include <periodyn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Ends the program unless the condition holds. */
#define CHECK(condition)                                                                           \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition);                \
            exit(1);                                                                               \
        }                                                                                          \
    } while (0)

/* Ends the program unless the call returns the status; shows the library's message. */
#define CHECK_STATUS(call, expected) check_status((call), (expected), #call, __FILE__, __LINE__)

static inline void check_status(pdn_status status, pdn_status expected, const char *call,
                                const char *file, int line)
{
    if (status != expected) {
        char message[512];
        pdn_last_error(message, sizeof message);
        fprintf(stderr, "%s:%d: %s gave %s instead of %s (last error: %s)\n", file, line, call,
                pdn_status_name(status), pdn_status_name(expected), message);
        exit(1);
    }
}

/* Ends the program unless the message of the last failure contains the text. */
#define CHECK_MESSAGE(text) check_message((text), __FILE__, __LINE__)

static inline void check_message(const char *text, const char *file, int line)
{
    char message[512];
    pdn_last_error(message, sizeof message);
    if (strstr(message, text) == NULL) {
        fprintf(stderr, "%s:%d: \"%s\" is not in \"%s\"\n", file, line, text, message);
        exit(1);
    }
}

/* Ids of the things of a kind, from 0 in the order in which they were added. */
#define NODE(number) (PDN_FIRST_NODE + (number))
#define JOINT(number) (PDN_FIRST_JOINT + (number))
#define BEAM_ELEMENT(number) (PDN_FIRST_BEAM_ELEMENT + (number))
#define SHELL_ELEMENT(number) (PDN_FIRST_SHELL_ELEMENT + (number))
#define FORCE(number) (PDN_FIRST_FORCE + (number))
#define RELATION(number) (PDN_FIRST_RELATION + (number))
#define PARAMETER(number) (PDN_FIRST_PARAMETER + (number))
#define LOAD(number) (PDN_FIRST_LOAD + (number))
#define BEAM_LOAD(number) (PDN_FIRST_BEAM_LOAD + (number))
#define SHELL_LOAD(number) (PDN_FIRST_SHELL_LOAD + (number))
#define INERTIA(number) (PDN_FIRST_INERTIA + (number))
#define PRESCRIBED(number) (PDN_FIRST_PRESCRIBED + (number))

/* What names nothing in a small model, whatever is asked for. */
#define NO_IDS                                                                                     \
    -2, 0, 99, NODE(99), JOINT(99), BEAM_ELEMENT(99), SHELL_ELEMENT(99), FORCE(99), RELATION(99),  \
        PARAMETER(99), LOAD(99), BEAM_LOAD(99), SHELL_LOAD(99), INERTIA(99), PRESCRIBED(99),       \
        INT32_MAX, INT32_MIN

#endif

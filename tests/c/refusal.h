/* Calls that must be refused: status, start of the message, and nothing changed.
 *
 * Before including it a test defines its arguments `in` and results `out` (static structs), and
 * `static int model_changed(void)`. */
#ifndef PDN_TEST_REFUSAL_H
#define PDN_TEST_REFUSAL_H

#include "check.h"
#include "constants.h"
#include <math.h>

#define LENGTH(array) (sizeof(array) / sizeof *(array))

static int refusals;

static void check_refusal(const char *start, const void *before, const char *call, int line)
{
    unsigned char pattern[sizeof out];
    char message[512];
    memset(pattern, 0x5a, sizeof pattern);
    pdn_last_error(message, sizeof message);
    if (strncmp(message, start, strlen(start)) != 0) {
        fprintf(stderr, "line %d: %s: \"%s\" does not start with \"%s\"\n", line, call, message,
                start);
        exit(1);
    }
    if (memcmp(pattern, &out, sizeof out) != 0 || memcmp(before, &in, sizeof in) != 0 ||
        model_changed()) {
        fprintf(stderr, "line %d: %s: failed, yet changed something\n", line, call);
        exit(1);
    }
    refusals++;
}

/* The call fails with the status and a message that starts so, and changes nothing. */
#define REFUSED(call, status, start)                                                               \
    do {                                                                                           \
        unsigned char before[sizeof in];                                                           \
        memcpy(before, &in, sizeof in);                                                            \
        memset(&out, 0x5a, sizeof out);                                                            \
        CHECK_STATUS(call, status);                                                                \
        check_refusal(start, before, #call, __LINE__);                                             \
    } while (0)

/* The call, with each of the values put in place of the variable. */
#define REFUSES_EACH(variable, type, values, call, status, start)                                  \
    do {                                                                                           \
        const type saved_ = (variable);                                                            \
        size_t i_;                                                                                 \
        for (i_ = 0; i_ < LENGTH(values); i_++) {                                                  \
            (variable) = (values)[i_];                                                             \
            REFUSED(call, status, start);                                                          \
        }                                                                                          \
        (variable) = saved_;                                                                       \
    } while (0)

/* Whether constants are of one list: each has a hundred of its own, kinds of quantities several. */
static inline int same_role(int32_t one, int32_t other)
{
    return one / 100 == other / 100 || (one < 1000 && other < 1000);
}

/* The call, with each constant of another role in place of the variable, which has one of its
 * own. */
#define REFUSES_OTHER_ROLES(variable, call, start)                                                 \
    do {                                                                                           \
        const int32_t own_ = (variable);                                                           \
        size_t c_;                                                                                 \
        CHECK(own_ >= 100);                                                                        \
        for (c_ = 0; c_ < LENGTH(all_constants); c_++) {                                           \
            if (same_role(own_, all_constants[c_]))                                                \
                continue;                                                                          \
            (variable) = all_constants[c_];                                                        \
            REFUSED(call, PDN_ERR_VALUE, start);                                                   \
        }                                                                                          \
        (variable) = own_;                                                                         \
    } while (0)

static const double not_finite[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
static const int32_t bad_enums[] = {-1, 99, INT32_MAX, INT32_MIN};

#define REFUSES_NOT_FINITE(variable, call, name)                                                   \
    REFUSES_EACH(variable, double, not_finite, call, PDN_ERR_NOT_FINITE,                           \
                 name ": expected a finite number, got ")

/* The call, with each of bad_ids as an object of a quantity: one of its own kind is refused by the
 * name of that kind, any other by the name of the field. */
#define REFUSES_OBJECTS(variable, call, own, field)                                                \
    do {                                                                                           \
        const int32_t good_ = (variable), span_ = PDN_FIRST_JOINT - PDN_FIRST_NODE;                \
        size_t i_;                                                                                 \
        for (i_ = 0; i_ < LENGTH(bad_ids); i_++) {                                                 \
            (variable) = bad_ids[i_];                                                              \
            REFUSED(call, PDN_ERR_ID,                                                              \
                    bad_ids[i_] / span_ == good_ / span_ ? own ": expected "                       \
                                                         : "quantity." field ": expected ");       \
        }                                                                                          \
        (variable) = good_;                                                                        \
    } while (0)

/* The call, with each of the first entries of an array not finite. */
#define REFUSES_NOT_FINITE_ENTRIES(array, length, call, name)                                      \
    do {                                                                                           \
        size_t k_;                                                                                 \
        for (k_ = 0; k_ < (size_t)(length); k_++) {                                                \
            char start_[80];                                                                       \
            snprintf(start_, sizeof start_, "%s[%d]: expected a finite number, got ", name,        \
                     (int)k_);                                                                     \
            REFUSES_EACH((array)[k_], double, not_finite, call, PDN_ERR_NOT_FINITE, start_);       \
        }                                                                                          \
    } while (0)

#endif

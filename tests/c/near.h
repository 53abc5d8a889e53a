/* Numbers that must be near each other, and texts that a report must contain. */
#ifndef PDN_TEST_NEAR_H
#define PDN_TEST_NEAR_H

#include "check.h"
#include <math.h>

#define PI 3.14159265358979323846

/* Ends the program unless both numbers differ by no more than the tolerance. */
#define CHECK_NEAR(a, b, tolerance) check_near((a), (b), (tolerance), #a, #b, __FILE__, __LINE__)

static inline void check_near(double a, double b, double tolerance, const char *first,
                              const char *second, const char *file, int line)
{
    /* Written so that NaN fails too. */
    if (!(fabs(a - b) <= tolerance)) {
        fprintf(stderr, "%s:%d: %s = %.15g, %s = %.15g\n", file, line, first, a, second, b);
        exit(1);
    }
}

/* Whether the report of a solution contains the text. */
static inline int reports(const pdn_solution *solution, const char *text)
{
    char report[4096];
    CHECK(pdn_solution_report(solution, report, sizeof report) < sizeof report);
    if (strstr(report, text) == NULL) {
        fprintf(stderr, "\"%s\" is not in:\n%s\n", text, report);
        return 0;
    }
    return 1;
}

#endif

/* All constants that choose something; tests/header.rs writes it. */
#ifndef PDN_TEST_CONSTANTS_H
#define PDN_TEST_CONSTANTS_H

#include "periodyn.h"

static const int32_t all_constants[] = {
};

#endif

/* Ends the program with the library's message if a call fails. */
#include <periodyn.h>
#include <stdio.h>
#include <stdlib.h>

#define TRY(call)                                                                                  \
    do {                                                                                           \
        if ((call) != PDN_OK) {                                                                    \
            char message[1000];                                                                    \
            pdn_last_error(message, sizeof message);                                               \
            fprintf(stderr, "%s\n", message);                                                      \
            exit(1);                                                                               \
        }                                                                                          \
    } while (0)

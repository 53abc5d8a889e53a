/* Overflows a signed number: UBSan must catch it. */
#include <limits.h>

int main(int argc, char **argv)
{
    /* So that no compiler makes something else of it. */
    volatile int number = INT_MAX - 1;
    (void)argv;
    number += 2 * argc;
    return number == 0;
}

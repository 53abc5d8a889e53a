/* Overflows a signed number: UBSan must catch it. */
#include <limits.h>

int main(int argc, char **argv)
{
    (void)argv;
    return INT_MAX - 1 + 2 * argc == 0;
}

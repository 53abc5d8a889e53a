/* Gives the library an array that is shorter than told: under AddressSanitizer the library itself,
   not this program, must be caught reading beyond it. */
#include <periodyn.h>
#include <stdlib.h>

int main(void)
{
    pdn_table *table = NULL;
    double *const times = malloc(3 * sizeof *times);
    for (int i = 0; i < 3; i++) {
        times[i] = i;
    }
    (void)pdn_table_new(times, 1000, &table);
    pdn_table_free(table);
    free(times);
    return 0;
}

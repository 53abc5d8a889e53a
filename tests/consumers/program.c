/* The program that every consumer builds. Its output does not matter, only that it ends with 0. */
#include <periodyn.h>
#include <stdio.h>

int main(void)
{
    printf("%s\n", pdn_build_info());
    if (pdn_version_check(PDN_VERSION_MAJOR, PDN_VERSION_MINOR) != PDN_OK) {
        char message[256];
        pdn_last_error(message, sizeof message);
        fprintf(stderr, "%s\n", message);
        return 1;
    }
    return 0;
}

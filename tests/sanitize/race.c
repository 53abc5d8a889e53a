/* A mistake on purpose: an array changes on one thread while the library reads it on another. */
#include <periodyn.h>
#include <pthread.h>
#include <stddef.h>

enum { COUNT = 1000 };

static double times[COUNT];

static void *change(void *unused)
{
    for (int i = 0; i < COUNT; i++) {
        times[i] = i + 0.5;
    }
    return unused;
}

int main(void)
{
    pthread_t thread;
    pdn_table *table = NULL;
    if (pthread_create(&thread, NULL, change, NULL) != 0) {
        return 2;
    }
    for (int i = 0; i < 100; i++) {
        (void)pdn_table_new(times, COUNT, &table);
        pdn_table_free(table);
    }
    return pthread_join(thread, NULL);
}

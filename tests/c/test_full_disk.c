/* A disk that is full after any number of bytes: PDN_ERR_IO, what was there stays as it was, and
   nothing is left beside it. Each case is a process whose files may be only so long. */
/* For fork and setrlimit. */
#define _XOPEN_SOURCE 700
#include "driven_arm.h"
#include <dirent.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static pdn_solution *solution;
static pdn_table *table;

static pdn_status save(const char *path)
{
    return pdn_solution_save(solution, path);
}

static pdn_status write_table(const char *path)
{
    return pdn_table_write_csv(table, path);
}

/* The bytes of a file; 0 if there is none. */
static size_t length_of(const char *path)
{
    struct stat about;
    return stat(path, &about) == 0 ? (size_t)about.st_size : 0;
}

static int entries(const char *folder)
{
    DIR *const directory = opendir(folder);
    int count = 0;
    CHECK(directory != NULL);
    while (readdir(directory) != NULL) {
        count++;
    }
    closedir(directory);
    return count;
}

/* Writes with so much room: whether there was enough. */
static int fits(pdn_status (*write)(const char *), const char *path, size_t room)
{
    const pid_t child = fork();
    int status = 0;
    CHECK(child >= 0);
    if (child == 0) {
        struct rlimit limit;
        pdn_status result;
        limit.rlim_cur = limit.rlim_max = room;
        CHECK(setrlimit(RLIMIT_FSIZE, &limit) == 0);
        /* Else the system ends the process, as it does not where a disk is full. */
        CHECK(signal(SIGXFSZ, SIG_IGN) != SIG_ERR);
        result = write(path);
        if (result == PDN_ERR_IO) {
            char message[512];
            pdn_last_error(message, sizeof message);
            CHECK(strstr(message, "cannot write") != NULL && strstr(message, path) != NULL);
        }
        _exit(result == PDN_OK ? 0 : result == PDN_ERR_IO ? 77 : 1);
    }
    CHECK(waitpid(child, &status, 0) == child);
    CHECK(WIFEXITED(status));
    if (WEXITSTATUS(status) != 0 && WEXITSTATUS(status) != 77) {
        fprintf(stderr, "%s, room for %zu bytes: status %d\n", path, room, status);
        exit(1);
    }
    return WEXITSTATUS(status) == 0;
}

static void any_room(pdn_status (*write)(const char *), const char *folder, const char *name)
{
    char path[200];
    size_t whole, room;
    int refused = 0;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    CHECK_STATUS(write(path), PDN_OK);
    whole = length_of(path);
    CHECK(whole > 100);
    CHECK(remove(path) == 0);
    for (room = 0; room < whole; room += 1 + whole / 23) {
        FILE *old;
        const int count = entries(folder);
        CHECK(!fits(write, path, room));
        CHECK(length_of(path) == 0 && entries(folder) == count);
        /* What was there. */
        old = fopen(path, "w");
        CHECK(old != NULL && fputs("old", old) >= 0 && fclose(old) == 0);
        CHECK(!fits(write, path, room));
        CHECK(length_of(path) == 3 && entries(folder) == count + 1);
        CHECK(remove(path) == 0);
        refused++;
    }
    CHECK(refused > 20);
    CHECK(fits(write, path, whole + 4096) && length_of(path) == whole);
    CHECK(remove(path) == 0);
    printf("%s: %zu bytes, refused with %d amounts of less room\n", name, whole, refused);
}

/* A device without room, where the system has it. */
static void a_full_device(void)
{
    if (access("/dev/full", W_OK) == 0) {
        CHECK_STATUS(save("/dev/full"), PDN_ERR_IO);
        CHECK_STATUS(write_table("/dev/full"), PDN_ERR_IO);
    }
}

int main(void)
{
    char folder[] = "full_disk_XXXXXX";
    driven_arm parts;
    pdn_periodic_options options;
    double times[400], values[400];
    pdn_model *const model = make_driven_arm(4, 3, &parts);
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = 7;
    CHECK_STATUS(pdn_solve_periodic(model, 2, &options, &solution), PDN_OK);
    for (int i = 0; i < 400; i++) {
        times[i] = i;
        values[i] = 1.0 / (i + 1);
    }
    CHECK_STATUS(pdn_table_new(times, 400, &table), PDN_OK);
    CHECK_STATUS(pdn_table_add_values(table, "x", values, 400), PDN_OK);
    CHECK(mkdtemp(folder) != NULL);
    any_room(save, folder, "solution.pdn");
    any_room(write_table, folder, "table.csv");
    a_full_device();
    CHECK(rmdir(folder) == 0);
    pdn_table_free(table);
    pdn_solution_free(solution);
    pdn_model_free(model);
    return 0;
}

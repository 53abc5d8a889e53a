/* Studies of many cases over the ranks of MPI, with their results in one file. */

#include "internal.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

/* Widths of the columns: number of the case, status, a number, check sum. */
enum { TASK = 9, STATUS = 11, NUMBER = 24, SUM = 8 };
/* How often others get their turn between two cases of the first rank. */
enum { TURNS = 100 };
static const size_t MOST_TASKS = 999999999, MOST_RESULTS = 1000000;

/* Bytes of a line, all of which are as long. */
static size_t line_length(size_t count)
{
    return TASK + 1 + STATUS + 1 + count * (NUMBER + 1) + SUM + 1;
}

/* CRC-32, as of zip. */
static uint32_t check_sum(const char *text, size_t length)
{
    uint32_t sum = 0xffffffffu;
    for (size_t i = 0; i < length; ++i) {
        sum ^= (unsigned char)text[i];
        for (int bit = 0; bit < 8; ++bit) {
            sum = (sum >> 1) ^ (sum & 1 ? 0xedb88320u : 0);
        }
    }
    return ~sum;
}

static void end_line(char *line, size_t length)
{
    char sum[SUM + 1];
    snprintf(sum, sizeof sum, "%08" PRIx32, check_sum(line, length - SUM - 1));
    memcpy(line + length - SUM - 1, sum, SUM);
    line[length - 1] = '\n';
}

/* The first line tells how many cases and results there are. */
static void write_head(char *line, size_t tasks, size_t count)
{
    const size_t length = line_length(count);
    char head[64];
    memset(line, ' ', length);
    const int written = snprintf(head, sizeof head, "%9zu,%11zu,", tasks, count);
    memcpy(line, head, (size_t)written);
    end_line(line, length);
}

static void write_line(char *line, size_t task, int32_t status, const double *results, size_t count)
{
    const size_t length = line_length(count);
    char column[64];
    size_t at = (size_t)snprintf(column, sizeof column, "%9zu,%11" PRId32 ",", task, status);
    memset(line, ' ', length);
    memcpy(line, column, at);
    for (size_t i = 0; i < count; ++i) {
        snprintf(column, sizeof column, "%24.16e,", results[i]);
        memcpy(line + at, column, NUMBER + 1);
        at += NUMBER + 1;
    }
    end_line(line, length);
}

/* Whether a line is whole, and that of this case; its status and numbers. */
static int read_line(const char *line, size_t task, size_t count, int32_t *status, double *results)
{
    const size_t length = line_length(count);
    char column[NUMBER + 1] = "";
    char sum[SUM + 1] = "";
    memcpy(sum, line + length - SUM - 1, SUM);
    if (line[length - 1] != '\n' || strtoul(sum, NULL, 16) != check_sum(line, length - SUM - 1)) {
        return 0;
    }
    memcpy(column, line, TASK);
    if (strtoull(column, NULL, 10) != task) {
        return 0;
    }
    memset(column, 0, sizeof column);
    memcpy(column, line + TASK + 1, STATUS);
    *status = (int32_t)strtol(column, NULL, 10);
    for (size_t i = 0; results != NULL && i < count; ++i) {
        memcpy(column, line + TASK + 1 + STATUS + 1 + i * (NUMBER + 1), NUMBER);
        results[i] = strtod(column, NULL);
    }
    return 1;
}

/* A study on its way. */
struct sweep {
    MPI_Comm comm;
    int rank;
    size_t tasks, count;
    MPI_File file;
    /* The place of the next case among those that are open, on the first rank, and what it was. */
    MPI_Win window;
    int64_t *next, found;
    /* For each case, whether its result is known, and whether it failed. */
    char *known;
    /* Cases that are not. */
    size_t *open, open_count;
    char *line;
    double *results;
    pdn_sweep_report report;
};

static pdn_status of_memory(void)
{
    return pdn_failure(PDN_ERR_MEMORY, "no memory for the study");
}

static pdn_status of_mpi(const char *what)
{
    return pdn_failure(PDN_ERR_PETSC, "%s failed", what);
}

/* What the file has of an earlier run; on the first rank. */
static pdn_status read_known(struct sweep *s, const char *path)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        return PDN_OK; /* a new study */
    }
    const size_t length = line_length(s->count);
    char *head = malloc(length);
    pdn_status status = head == NULL ? of_memory() : PDN_OK;
    size_t got = status == PDN_OK ? fread(s->line, 1, length, file) : 0;
    if (status == PDN_OK && got > 0) {
        write_head(head, s->tasks, s->count);
        if (got != length || memcmp(head, s->line, length) != 0) {
            status = pdn_failure(PDN_ERR_FORMAT,
                                 "%s: expected a study of %zu cases with %zu results, got another "
                                 "file",
                                 path, s->tasks, s->count);
        }
    }
    for (size_t task = 0; status == PDN_OK && got > 0 && task < s->tasks; ++task) {
        int32_t ended;
        if (fread(s->line, 1, length, file) != length) {
            break;
        }
        if (read_line(s->line, task, s->count, &ended, NULL)) {
            s->known[task] = ended == PDN_OK ? 1 : 2;
        }
    }
    free(head);
    fclose(file);
    return status;
}

/* Asks for the next of the open cases. Where ranks have no other way to each other's memory, as by
 * TCP, the first answers when it is in MPI: so the answer is waited for after a case, not before
 * it, and that rank gives others the time. */
static int ask(struct sweep *s, MPI_Request *request)
{
    static const int64_t one = 1;
    return MPI_Rget_accumulate(&one, 1, MPI_INT64_T, &s->found, 1, MPI_INT64_T, 0, 0, 1,
                               MPI_INT64_T, MPI_SUM, s->window, request);
}

/* Solves a case and writes its line. */
static pdn_status solve(struct sweep *s, size_t task, pdn_sweep_fn function, void *user_data)
{
    const size_t length = line_length(s->count);
    memset(s->results, 0, s->count * sizeof *s->results);
    const int32_t ended = function(task, s->results, s->count, user_data);
    write_line(s->line, task, ended, s->results, s->count);
    const MPI_Offset at = (MPI_Offset)(length * (task + 1));
    if (MPI_File_write_at(s->file, at, s->line, (int)length, MPI_CHAR, MPI_STATUS_IGNORE) !=
        MPI_SUCCESS) {
        return pdn_failure(PDN_ERR_IO, "case %zu cannot be written", task);
    }
    s->report.own++;
    s->report.failed += ended != PDN_OK;
    return PDN_OK;
}

/* Solves cases until there are none left. */
static pdn_status run(struct sweep *s, pdn_sweep_fn function, void *user_data)
{
    MPI_Request request;
    int code = ask(s, &request);
    while (code == MPI_SUCCESS) {
        code = MPI_Wait(&request, MPI_STATUS_IGNORE);
        for (int i = 0; i < TURNS && s->rank == 0; ++i) {
            int unused;
            MPI_Iprobe(MPI_ANY_SOURCE, 0, s->comm, &unused, MPI_STATUS_IGNORE);
        }
        const size_t place = (size_t)s->found;
        if (code != MPI_SUCCESS || place >= s->open_count) {
            break;
        }
        code = ask(s, &request);
        if (code != MPI_SUCCESS) {
            break;
        }
        const pdn_status status = solve(s, s->open[place], function, user_data);
        if (status != PDN_OK) {
            MPI_Wait(&request, MPI_STATUS_IGNORE);
            return status;
        }
    }
    return code == MPI_SUCCESS ? PDN_OK : of_mpi("MPI_Rget_accumulate");
}

static pdn_status open_file(struct sweep *s, const char *path)
{
    const size_t length = line_length(s->count);
    /* Errors of files are told, not fatal, as MPI has it by default. */
    if (MPI_File_open(s->comm, path, MPI_MODE_CREATE | MPI_MODE_RDWR, MPI_INFO_NULL, &s->file) !=
        MPI_SUCCESS) {
        return pdn_failure(PDN_ERR_IO, "%s cannot be opened", path);
    }
    int code = MPI_SUCCESS;
    if (s->rank == 0) {
        write_head(s->line, s->tasks, s->count);
        code = MPI_File_write_at(s->file, 0, s->line, (int)length, MPI_CHAR, MPI_STATUS_IGNORE);
    }
    return code == MPI_SUCCESS ? PDN_OK : pdn_failure(PDN_ERR_IO, "%s cannot be written", path);
}

static pdn_status study(struct sweep *s, pdn_sweep_fn function, void *user_data, const char *path)
{
    pdn_status status = s->rank == 0 ? read_known(s, path) : PDN_OK;
    status = pdn_agreed(s->comm, status);
    if (status != PDN_OK) {
        return status;
    }
    MPI_Bcast(s->known, (int)s->tasks, MPI_CHAR, 0, s->comm);
    for (size_t task = 0; task < s->tasks; ++task) {
        s->report.known += s->known[task] != 0;
        s->report.failed += s->rank == 0 && s->known[task] == 2;
        if (!s->known[task]) {
            s->open[s->open_count++] = task;
        }
    }
    status = pdn_agreed(s->comm, open_file(s, path));
    if (status == PDN_OK &&
        MPI_Win_allocate(s->rank == 0 ? sizeof *s->next : 0, sizeof *s->next, MPI_INFO_NULL,
                         s->comm, &s->next, &s->window) != MPI_SUCCESS) {
        status = of_mpi("MPI_Win_allocate");
    }
    if (status == PDN_OK) {
        if (s->rank == 0) {
            *s->next = 0;
        }
        MPI_Barrier(s->comm);
        MPI_Win_lock_all(0, s->window);
        status = run(s, function, user_data);
        MPI_Win_unlock_all(s->window);
        status = pdn_agreed(s->comm, status);
        MPI_Win_free(&s->window);
    }
    if (s->file != MPI_FILE_NULL) {
        MPI_File_close(&s->file);
    }
    return status;
}

void pdn_sweep_report_init(pdn_sweep_report *report, size_t struct_size)
{
    const pdn_sweep_report blank = {0};
    pdn_write_defaults(report, struct_size, &blank, sizeof blank);
}

static pdn_status check(size_t tasks, size_t count, pdn_sweep_fn function, const char *path,
                        const pdn_sweep_report *report)
{
    if (function == NULL || path == NULL) {
        return pdn_missing(function == NULL ? "function" : "path");
    }
    if (tasks == 0 || tasks > MOST_TASKS) {
        return pdn_failure(PDN_ERR_SIZE, "tasks: expected from 1 to %zu, got %zu", MOST_TASKS,
                           tasks);
    }
    if (count > MOST_RESULTS) {
        return pdn_failure(PDN_ERR_SIZE, "count: expected at most %zu, got %zu", MOST_RESULTS,
                           count);
    }
    return report == NULL ? PDN_OK
                          : pdn_check_size("report", report->struct_size, sizeof *report);
}

pdn_status pdn_sweep(MPI_Comm comm, size_t tasks, size_t count, pdn_sweep_fn function,
                     void *user_data, const char *path, pdn_sweep_report *report)
{
    struct sweep s = {.comm = comm, .tasks = tasks, .count = count, .file = MPI_FILE_NULL};
    pdn_status status = check(tasks, count, function, path, report);
    MPI_Comm_rank(comm, &s.rank);
    if (status == PDN_OK) {
        s.known = calloc(tasks, 1);
        s.open = malloc(tasks * sizeof *s.open);
        s.line = malloc(line_length(count));
        s.results = malloc((count + 1) * sizeof *s.results);
        if (s.known == NULL || s.open == NULL || s.line == NULL || s.results == NULL) {
            status = of_memory();
        }
    }
    status = pdn_agreed(comm, status);
    if (status == PDN_OK) {
        status = study(&s, function, user_data, path);
    }
    if (status == PDN_OK) {
        unsigned long long own[2] = {s.report.own, s.report.failed}, all[2];
        MPI_Allreduce(own, all, 2, MPI_UNSIGNED_LONG_LONG, MPI_SUM, comm);
        s.report.solved = (size_t)all[0];
        s.report.failed = (size_t)all[1];
        if (report != NULL) {
            s.report.struct_size = report->struct_size;
            *report = s.report;
        }
    }
    free(s.known);
    free(s.open);
    free(s.line);
    free(s.results);
    return status;
}

pdn_status pdn_sweep_read(const char *path, size_t task, int32_t *status, double *results,
                          size_t count)
{
    if (path == NULL || status == NULL || (results == NULL && count > 0)) {
        return PDN_ERR_NULL;
    }
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        return PDN_ERR_IO;
    }
    const size_t length = line_length(count);
    size_t tasks = 0, results_there = 0;
    char head[TASK + 1 + STATUS + 2] = "";
    char *line = malloc(length);
    pdn_status found = line == NULL ? PDN_ERR_MEMORY : PDN_OK;
    if (found == PDN_OK && (fread(head, 1, TASK + 1 + STATUS + 1, file) != TASK + 1 + STATUS + 1 ||
                            sscanf(head, "%zu,%zu,", &tasks, &results_there) != 2)) {
        found = PDN_ERR_FORMAT;
    } else if (found == PDN_OK && (results_there != count || task >= tasks)) {
        found = PDN_ERR_SIZE;
    }
    if (found == PDN_OK) {
        int32_t ended;
        const int there = fseek(file, (long)(length * (task + 1)), SEEK_SET) == 0 &&
                          fread(line, 1, length, file) == length &&
                          read_line(line, task, count, &ended, results);
        found = there ? PDN_OK : PDN_ERR_NOT_AVAILABLE;
        if (there) {
            *status = ended;
        }
    }
    free(line);
    fclose(file);
    return found;
}

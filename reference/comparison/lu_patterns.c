/* One LU factorization (LAPACK's dgesv) for each pattern of a mode problem. For compare.py.
 *
 * usage: lu_patterns FILE MOST
 * FILE: n as 64-bit integer, then C+, C- (column by column) and b as 64-bit floating-point numbers.
 * Tries the first MOST patterns (bit k set: column k of C-) and prints one JSON object with the patterns that have a
 * solution y >= -1e-9 max |y|.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

extern void dgesv_(const int *n, const int *nrhs, double *a, const int *lda, int *pivots, double *b, const int *ldb,
                   int *info);

static double seconds(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static void fail(const char *message) {
    fprintf(stderr, "%s\n", message);
    exit(1);
}

static double *read_numbers(FILE *file, size_t count) {
    double *numbers = malloc((count ? count : 1) * sizeof(double));
    if (!numbers || fread(numbers, sizeof(double), count, file) != count) fail("the file is too short");
    return numbers;
}

static int is_solution(const double *y, int n) {
    double least = 0.0, largest = 0.0;
    for (int k = 0; k < n; ++k) {
        least = fmin(least, y[k]);
        largest = fmax(largest, fabs(y[k]));
    }
    return least >= -1e-9 * largest;
}

int main(int argc, char **argv) {
    if (argc != 3) fail("usage: lu_patterns FILE MOST");
    FILE *file = fopen(argv[1], "rb");
    int64_t size = 0;
    if (!file || fread(&size, sizeof size, 1, file) != 1 || size < 1 || size > 40) fail("no problem in the file");
    const int n = (int)size, one = 1;
    const size_t entries = (size_t)n * (size_t)n;
    const double *columns[2] = {read_numbers(file, entries), read_numbers(file, entries)};
    const double *load = read_numbers(file, (size_t)n);
    fclose(file);
    double *matrix = malloc(entries * sizeof(double)), *y = malloc((size_t)n * sizeof(double));
    int *pivots = malloc((size_t)n * sizeof(int));

    uint64_t patterns = (uint64_t)1 << n, singular = 0, most = strtoull(argv[2], NULL, 10);
    if (most < patterns) patterns = most;
    size_t found = 0, room = 16;
    uint64_t *solutions = malloc(room * sizeof(uint64_t));
    double start = seconds();
    for (uint64_t bits = 0; bits < patterns; ++bits) {
        for (int k = 0; k < n; ++k)
            memcpy(matrix + k * n, columns[bits >> k & 1] + k * n, (size_t)n * sizeof(double));
        memcpy(y, load, (size_t)n * sizeof(double));
        int info = 0;
        dgesv_(&n, &one, matrix, &n, pivots, y, &n, &info);
        singular += info != 0;
        if (info != 0 || !is_solution(y, n)) continue;
        if (found == room) solutions = realloc(solutions, (room *= 2) * sizeof(uint64_t));
        if (!solutions) fail("out of memory");
        solutions[found++] = bits;
    }
    double elapsed = seconds() - start;
    printf("{\"seconds\": %.9f, \"patterns\": %llu, \"singular\": %llu, \"solutions\": [", elapsed,
           (unsigned long long)patterns, (unsigned long long)singular);
    for (size_t at = 0; at < found; ++at) printf("%s%llu", at ? ", " : "", (unsigned long long)solutions[at]);
    printf("]}\n");
    return 0;
}

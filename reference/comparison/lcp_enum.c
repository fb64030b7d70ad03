/* Siconos' lcp_enum on one problem: counts all solutions, then lists them. For compare.py.
 *
 * usage: lcp_enum FILE LIST
 * FILE: n as 64-bit integer, then M (column by column) and q as 64-bit floating-point numbers.
 * Prints one JSON object. With LIST = 1 the solutions are listed, which takes about another pass: lcp_enum counts all
 * solutions in one call but returns only the last one, so it is called anew from behind each solution.
 */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include <LCP_Solvers.h>
#include <LinearComplementarityProblem.h>
#include <NumericsMatrix.h>
#include <SolverOptions.h>
#include <lcp_cst.h>

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

int main(int argc, char **argv) {
    if (argc != 3) fail("usage: lcp_enum FILE LIST");
    FILE *file = fopen(argv[1], "rb");
    int64_t n = 0;
    if (!file || fread(&n, sizeof n, 1, file) != 1 || n < 1 || n > 30) fail("no problem in the file");
    double *matrix = read_numbers(file, (size_t)(n * n));
    double *z = calloc((size_t)n, sizeof(double)), *w = calloc((size_t)n, sizeof(double));
    LinearComplementarityProblem problem;
    problem.size = (int)n;
    problem.M = NM_create_from_data(NM_DENSE, (int)n, (int)n, matrix);
    problem.q = read_numbers(file, (size_t)n);
    fclose(file);

    SolverOptions *options = solver_options_create(SICONOS_LCP_ENUM);
    int info = 0;
    options->iparam[SICONOS_LCP_IPARAM_ENUM_MULTIPLE_SOLUTIONS] = 1;
    options->iparam[SICONOS_LCP_IPARAM_ENUM_NUMBER_OF_SOLUTIONS] = 0;
    double start = seconds();
    lcp_enum(&problem, z, w, &info, options);
    double elapsed = seconds() - start;
    printf("{\"seconds\": %.9f, \"count\": %d, \"tolerance\": %g, \"solutions\": ", elapsed,
           options->iparam[SICONOS_LCP_IPARAM_ENUM_NUMBER_OF_SOLUTIONS], options->dparam[SICONOS_DPARAM_TOL]);
    if (argv[2][0] != '1') {
        printf("null}\n");
        return 0;
    }
    printf("[");
    options->iparam[SICONOS_LCP_IPARAM_ENUM_MULTIPLE_SOLUTIONS] = 0;
    int64_t next = 0, count = 0;
    while (next < (int64_t)1 << n) {
        options->iparam[SICONOS_LCP_IPARAM_ENUM_SEED] = (int)next;
        lcp_enum(&problem, z, w, &info, options);
        int64_t found = options->iparam[SICONOS_LCP_IPARAM_ENUM_CURRENT_ENUM];
        /* After the last pattern the enumeration goes on with the first one. */
        if (info != 0 || found < next) break;
        printf("%s[", count++ ? ", " : "");
        for (int64_t k = 0; k < n; ++k) printf("%s%.17g", k ? ", " : "", z[k] - w[k]);
        printf("]");
        next = found + 1;
    }
    printf("]}\n");
    return 0;
}

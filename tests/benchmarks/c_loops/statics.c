/* Yardstick: static equilibrium of a defective ball bearing over cage angles, five degrees of
 * freedom, with all 15 stiffness terms.
 *
 * Plain C, one angle after the other, as an engineer would write it who knows what is costly:
 * Newton on the convex contact energy with a line search, warm-started by extrapolation from the
 * two angles before, cosines and sines of the balls by rotation, square roots only for balls that
 * touch, and the Hessian of the last step kept as the stiffness. Outer race; `arc` is the part of
 * the arc from the edge that Equation 6 takes: 0.5 published, 1 chord.
 *
 * Displacements are (x, y, z, rx, ry) [m, rad]; stiffness terms are the upper triangle by rows.
 */
#include <math.h>
#include <string.h>

#define MAX_BALLS 64

typedef struct {
    double n_balls, ball_radius, contact_angle, groove_center_radius, groove_center_distance;
    double radial_clearance, load_deflection_factor, outer_raceway_radius;
    double extent, depth, center, arc;
    double load[5];
    double tolerance; /* of the residual over the load */
} Scene;

typedef struct {
    int n;
    double c[MAX_BALLS], s[MAX_BALLS], d[MAX_BALLS];
} Balls;

/* Drop of the ball centre, published edges. */
static double path(const Scene *p, double angle)
{
    double away = fabs(remainder(angle - p->center, 2.0 * M_PI));
    double s = 0.5 * p->extent - away;
    if (s <= 0.0) return 0.0;
    double reach = p->arc * p->outer_raceway_radius * s;
    double under = p->ball_radius * p->ball_radius - reach * reach;
    if (under < 0.0) return p->depth;
    double drop = p->ball_radius - sqrt(under);
    return drop < p->depth ? drop : p->depth;
}

/* Energy of the contacts, their load g (5) and stiffness k (15); load of each ball if wanted. */
static double contacts(const Scene *p, const Balls *b, const double *q, double ca, double sa,
                       double *restrict g, double *restrict k, double *restrict ball_load)
{
    const double a0 = p->groove_center_distance, arm = p->groove_center_radius;
    const double factor = p->load_deflection_factor;
    const double r0 = a0 * ca - p->radial_clearance, z0 = a0 * sa + q[2];
    const double tx = arm * q[3], ty = arm * q[4];
    double energy = 0.0;
    double fc = 0, fs = 0, fz = 0, mzs = 0, mzc = 0;
    double rrcc = 0, rrcs = 0, rrss = 0, rzc = 0, rzs = 0, rzcc = 0, rzcs = 0, rzss = 0;
    double zz = 0, zzc = 0, zzs = 0, zzcc = 0, zzcs = 0, zzss = 0;
    for (int j = 0; j < b->n; j++) {
        const double c = b->c[j], s = b->s[j], d = b->d[j];
        double r = r0 + q[0] * c + q[1] * s - d * ca;
        double z = z0 + tx * s - ty * c - d * sa;
        const double along = r * ca + z * sa;
        const int passed = along < 0.0;
        if (passed) {
            r -= along * ca;
            z -= along * sa;
        }
        const double square = r * r + z * z;
        if (square <= a0 * a0) {
            if (ball_load) ball_load[j] = 0.0;
            continue;
        }
        const double a = sqrt(square), delta = a - a0, root = sqrt(delta);
        const double load = factor * delta * root, inverse = 1.0 / a;
        const double er = r * inverse, ez = z * inverse;
        if (ball_load) ball_load[j] = load;
        energy += 0.4 * load * delta;
        fc += load * er * c;
        fs += load * er * s;
        fz += load * ez;
        mzs += load * ez * s;
        mzc += load * ez * c;
        const double k1 = 1.5 * factor * root, k2 = passed ? 0.0 : load * inverse;
        const double rr = k1 * er * er + k2 * ez * ez, rz = (k1 - k2) * er * ez;
        const double zzj = k1 * ez * ez + k2 * er * er;
        const double cc = c * c, cs = c * s, ss = s * s;
        rrcc += rr * cc, rrcs += rr * cs, rrss += rr * ss;
        rzc += rz * c, rzs += rz * s, rzcc += rz * cc, rzcs += rz * cs, rzss += rz * ss;
        zz += zzj, zzc += zzj * c, zzs += zzj * s;
        zzcc += zzj * cc, zzcs += zzj * cs, zzss += zzj * ss;
    }
    g[0] = fc, g[1] = fs, g[2] = fz, g[3] = arm * mzs, g[4] = -arm * mzc;
    k[0] = rrcc, k[1] = rrcs, k[2] = rzc, k[3] = arm * rzcs, k[4] = -arm * rzcc;
    k[5] = rrss, k[6] = rzs, k[7] = arm * rzss, k[8] = -arm * rzcs;
    k[9] = zz, k[10] = arm * zzs, k[11] = -arm * zzc;
    k[12] = arm * arm * zzss, k[13] = -arm * arm * zzcs, k[14] = arm * arm * zzcc;
    return energy;
}

/* Solve K step = g by Cholesky, K the packed upper triangle; 0 if K is not positive definite. */
static int solve(const double *k, double shift, const double *g, double *restrict step)
{
    double u[5][5];
    int at = 0;
    for (int i = 0; i < 5; i++)
        for (int j = i; j < 5; j++) u[i][j] = k[at++];
    for (int i = 0; i < 5; i++) {
        u[i][i] *= 1.0 + shift;
        for (int m = 0; m < i; m++) u[i][i] -= u[m][i] * u[m][i];
        if (!(u[i][i] > 0.0)) return 0;
        u[i][i] = sqrt(u[i][i]);
        const double inverse = 1.0 / u[i][i];
        for (int j = i + 1; j < 5; j++) {
            for (int m = 0; m < i; m++) u[i][j] -= u[m][i] * u[m][j];
            u[i][j] *= inverse;
        }
    }
    for (int i = 0; i < 5; i++) {
        step[i] = g[i];
        for (int m = 0; m < i; m++) step[i] -= u[m][i] * step[m];
        step[i] /= u[i][i];
    }
    for (int i = 4; i >= 0; i--) {
        for (int m = i + 1; m < 5; m++) step[i] -= u[i][m] * step[m];
        step[i] /= u[i][i];
    }
    return 1;
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4];
}

/* Residual over the load, moments over the lever arm. */
static double residual_of(const Scene *p, const double *g, double size)
{
    const double arm = p->groove_center_radius;
    double worst = 0.0;
    for (int i = 0; i < 5; i++) {
        double r = fabs(g[i] - p->load[i]) / (i < 3 ? 1.0 : arm);
        if (r > worst) worst = r;
    }
    return worst / size;
}

/* Newton with line search at one angle, from q. Returns evaluations, negative if not converged. */
static int newton(const Scene *p, const Balls *b, double ca, double sa, double size, double *q,
                  double *restrict k, double *restrict ball_load, double *residual)
{
    double g[5], trial_g[5], trial_k[15], trial[5], gap[5], step[5];
    int evaluations = 1;
    double energy = contacts(p, b, q, ca, sa, g, k, ball_load) - dot(p->load, q);
    *residual = residual_of(p, g, size);
    while (*residual > p->tolerance) {
        if (evaluations > 200) return -evaluations;
        for (int i = 0; i < 5; i++) gap[i] = g[i] - p->load[i];
        double shift = 0.0;
        while (!solve(k, shift, gap, step)) {
            shift = shift > 0.0 ? 10.0 * shift : 1e-9;
            if (shift > 1e3) return -evaluations;
        }
        const double slope = dot(gap, step);
        double length = 1.0, e;
        for (;;) {
            for (int i = 0; i < 5; i++) trial[i] = q[i] - length * step[i];
            e = contacts(p, b, trial, ca, sa, trial_g, trial_k, ball_load) - dot(p->load, trial);
            evaluations++;
            /* rounding of the energy must not stop the last steps: 1e-13 of it is allowed */
            if (e <= energy - 1e-4 * length * slope + 1e-13 * (fabs(energy) + fabs(e))) break;
            length *= 0.5;
            if (length < 1e-10) return -evaluations;
        }
        energy = e;
        memcpy(q, trial, sizeof trial);
        memcpy(g, trial_g, sizeof g);
        memcpy(k, trial_k, sizeof trial_k);
        *residual = residual_of(p, g, size);
    }
    return evaluations;
}

/* A start where every ball presses a little in the direction of the load. */
static void first_guess(const Scene *p, double *q)
{
    const double *f = p->load;
    double radial = sqrt(f[0] * f[0] + f[1] * f[1]), a0 = p->groove_center_distance;
    double reach = p->radial_clearance + 0.3 * a0;
    q[0] = radial > 0.0 ? reach * f[0] / radial : 0.0;
    q[1] = radial > 0.0 ? reach * f[1] / radial : 0.0;
    q[2] = 0.1 * a0 * (f[2] < 0.0 ? -1.0 : 1.0);
    q[3] = q[4] = 0.0;
}

static double load_size(const Scene *p)
{
    double size = 0.0;
    for (int i = 0; i < 5; i++) {
        double f = fabs(p->load[i]) / (i < 3 ? 1.0 : p->groove_center_radius);
        if (f > size) size = f;
    }
    return size;
}

/* Equally spaced cage angles from `from`, `by` apart. Returns evaluations, negative on failure. */
int statics_curve(const Scene *p, int n_angles, double from, double by, double *q0,
                  double *displacement, double *stiffness, double *ball_load, double *residual)
{
    Balls b;
    b.n = (int)p->n_balls;
    const double ca = cos(p->contact_angle), sa = sin(p->contact_angle), size = load_size(p);
    const double turn_c = cos(by), turn_s = sin(by), spacing = 2.0 * M_PI / b.n;
    double q[5], before[5] = {0}, now[5] = {0};
    int total = 0, failed = 0;
    memcpy(q, q0, sizeof q);
    for (int j = 0; j < b.n; j++) b.c[j] = cos(from + j * spacing), b.s[j] = sin(from + j * spacing);
    for (int i = 0; i < n_angles; i++) {
        for (int j = 0; j < b.n; j++) {
            if (i > 0) {
                double c = b.c[j] * turn_c - b.s[j] * turn_s;
                b.s[j] = b.s[j] * turn_c + b.c[j] * turn_s;
                b.c[j] = c;
            }
            b.d[j] = path(p, from + i * by + j * spacing);
        }
        if (i >= 2)
            for (int m = 0; m < 5; m++) q[m] = 2.0 * now[m] - before[m];
        int used = newton(p, &b, ca, sa, size, q, stiffness + 15 * i, ball_load + b.n * i,
                          residual + i);
        total += used < 0 ? -used : used;
        failed |= used < 0;
        memcpy(before, now, sizeof now);
        memcpy(now, q, sizeof now);
        memcpy(displacement + 5 * i, q, sizeof q);
        if (i == 0) memcpy(q0, q, sizeof q);
    }
    return failed ? -total : total;
}

/* One curve from a cold start. */
int statics(const Scene *p, int n_angles, double from, double by, double *displacement,
            double *stiffness, double *ball_load, double *residual)
{
    double q0[5];
    first_guess(p, q0);
    return statics_curve(p, n_angles, from, by, q0, displacement, stiffness, ball_load, residual);
}

/* Maps of all 15 terms over extents × cage angles, each curve started from its neighbour's start.
 * `stiffness` is (n_extents, n_angles, 15), `loaded` the number of loaded balls. */
int statics_maps(const Scene *scene, int n_extents, double extent_by, int n_angles, double by,
                 double *stiffness, double *loaded, double *displacement, double *ball_load,
                 double *residual)
{
    Scene p = *scene;
    double q0[5];
    int total = 0, failed = 0, n = (int)p.n_balls;
    first_guess(&p, q0);
    for (int e = 0; e < n_extents; e++) {
        p.extent = e * extent_by;
        int used = statics_curve(&p, n_angles, 0.0, by, q0, displacement,
                                 stiffness + (long)e * n_angles * 15, ball_load, residual);
        total += used < 0 ? -used : used;
        failed |= used < 0;
        for (int i = 0; i < n_angles; i++) {
            double count = 0.0;
            for (int j = 0; j < n; j++) count += ball_load[i * n + j] > 0.0;
            loaded[(long)e * n_angles + i] = count;
        }
    }
    return failed ? -total : total;
}

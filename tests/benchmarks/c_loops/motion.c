/* Yardstick: motion of rotor and housing on a defective ball bearing, x and y of both bodies
 * (Equations 18 to 23, published contact law), by classical Runge-Kutta at a fixed step.
 *
 * Plain C. The geometry of one ball pass (cosine, sine, drop and its slope of every ball) is
 * tabulated over the cage angle and interpolated linearly: each step needs it twice. Balls that do
 * not touch cost two multiplications and a comparison. Tried and slower or no faster on the machine
 * this was written on: all balls at once without a branch (the square roots of the gaps cost more
 * than the branch), compressions first and forces after, the state in scalars instead of arrays.
 * What is left is one square root after the other: each stage waits for the one before.
 */
#include <math.h>
#include <stdlib.h>

#define LANES 16 /* at most so many balls; padded so that the table is read several at once */

typedef struct {
    double n_balls, ball_radius, radial_clearance, load_deflection_factor, outer_raceway_radius;
    double extent, depth, center, arc;
    double inner_inverse, outer_inverse; /* one over the masses */
    double stiffness_x, stiffness_y, damping_x, damping_y;
    double contact_damping, fx, fy, cage_speed;
} Scene;

typedef struct {
    double c[LANES], s[LANES], d[LANES], slope[LANES]; /* slope of d in time */
} Geometry;

static void path(const Scene *p, double angle, double *d, double *slope)
{
    const double away = remainder(angle - p->center, 2.0 * M_PI);
    const double s = 0.5 * p->extent - fabs(away);
    *d = *slope = 0.0;
    if (s <= 0.0) return;
    const double reach = p->arc * p->outer_raceway_radius, r = p->ball_radius;
    const double under = r * r - reach * reach * s * s;
    *d = p->depth;
    if (under <= 0.0) return;
    const double root = sqrt(under);
    if (r - root >= p->depth) return;
    *d = r - root;
    *slope = (away < 0.0 ? 1.0 : -1.0) * reach * reach * s / root;
}

/* Fill `nodes` + 1 entries over one ball spacing. */
static void tabulate(const Scene *p, int nodes, Geometry *table)
{
    const int n = (int)p->n_balls;
    const double spacing = 2.0 * M_PI / n;
    for (int k = 0; k <= nodes; k++)
        for (int j = 0; j < LANES; j++) {
            Geometry *g = table + k;
            g->c[j] = g->s[j] = g->slope[j] = 0.0;
            g->d[j] = 1.0; /* lanes without a ball never touch */
            if (j >= n) continue;
            const double angle = spacing * k / nodes + j * spacing;
            g->c[j] = cos(angle), g->s[j] = sin(angle);
            path(p, angle, &g->d[j], &g->slope[j]);
            g->slope[j] *= p->cage_speed;
            g->d[j] += p->radial_clearance;
        }
}

static inline void look_up(const Geometry *table, int nodes, double passes, Geometry *restrict now)
{
    const double at = (passes - floor(passes)) * nodes;
    const int k = (int)at;
    const double w = at - k;
    const double *a = (const double *)(table + k), *b = (const double *)(table + k + 1);
    double *out = (double *)now;
    for (int i = 0; i < 4 * LANES; i++) out[i] = a[i] + w * (b[i] - a[i]);
}

/* Force of the contacts on the inner ring is −(fx, fy). */
static inline void contacts(const Scene *p, const Geometry *g, const double *y, double *fx,
                            double *fy)
{
    const double dx = y[0] - y[2], dy = y[1] - y[3];
    /* velocities in the frame that turns with the cage: the rate of compression in one go */
    const double vx = y[4] - y[6] + p->cage_speed * dy, vy = y[5] - y[7] - p->cage_speed * dx;
    const double k = p->load_deflection_factor, c = p->contact_damping;
    double sum_x = 0.0, sum_y = 0.0;
    const int n = (int)p->n_balls;
    for (int j = 0; j < n; j++) {
        const double delta = dx * g->c[j] + dy * g->s[j] - g->d[j];
        if (delta > 0.0) {
            const double rate = vx * g->c[j] + vy * g->s[j] - g->slope[j];
            const double force = k * delta * sqrt(delta) + c * rate;
            sum_x += force * g->c[j];
            sum_y += force * g->s[j];
        }
    }
    *fx = sum_x;
    *fy = sum_y;
}

static inline void slope_of(const Scene *p, const Geometry *g, const double *y, double *restrict f)
{
    double fx, fy;
    contacts(p, g, y, &fx, &fy);
    const double mi = p->inner_inverse, mo = p->outer_inverse;
    for (int i = 0; i < 4; i++) f[i] = y[4 + i];
    f[4] = (p->fx - fx) * mi;
    f[5] = (p->fy - fy) * mi;
    f[6] = (fx - p->stiffness_x * y[2] - p->damping_x * y[6]) * mo;
    f[7] = (fy - p->stiffness_y * y[3] - p->damping_y * y[7]) * mo;
}

/* March `n_samples` from `y` (8), one step a sample. `states` (n, 8), `acceleration` (n, 2) of the
 * outer ring. `nodes` of the table over one ball pass. Returns 0, 1 without memory,
 * 2 for more balls than lanes. */
int motion(const Scene *p, double *restrict y, int n_samples, double step, int nodes,
           double *restrict states, double *restrict acceleration)
{
    if (p->n_balls > LANES) return 2;
    Geometry *table = aligned_alloc(64, (nodes + 2) * sizeof(Geometry));
    if (!table) return 1;
    tabulate(p, nodes, table);
    table[nodes + 1] = table[nodes];
    const double passes_a_step = p->cage_speed * step * p->n_balls / (2.0 * M_PI);
    Geometry start, middle, end;
    double k1[8], k2[8], k3[8], k4[8], t[8];
    look_up(table, nodes, 0.0, &start);
    for (int i = 0; i < n_samples; i++) {
        slope_of(p, &start, y, k1);
        for (int m = 0; m < 8; m++) states[8L * i + m] = y[m];
        acceleration[2L * i] = k1[6], acceleration[2L * i + 1] = k1[7];
        look_up(table, nodes, (i + 0.5) * passes_a_step, &middle);
        look_up(table, nodes, (i + 1.0) * passes_a_step, &end);
        for (int m = 0; m < 8; m++) t[m] = y[m] + 0.5 * step * k1[m];
        slope_of(p, &middle, t, k2);
        for (int m = 0; m < 8; m++) t[m] = y[m] + 0.5 * step * k2[m];
        slope_of(p, &middle, t, k3);
        for (int m = 0; m < 8; m++) t[m] = y[m] + step * k3[m];
        slope_of(p, &end, t, k4);
        for (int m = 0; m < 8; m++) y[m] += step / 6.0 * (k1[m] + 2.0 * (k2[m] + k3[m]) + k4[m]);
        start = end;
    }
    free(table);
    return 0;
}

/* The same in x, y, z and both tilts of both bodies, tilts times the groove radius, moments over
 * it. Balls have three more coordinates and a contact angle that follows the load: a square root
 * and a division more for each that touches. */
typedef struct {
    double cos_angle, sin_angle, groove_distance; /* unloaded contact angle; A0 */
    double load[5], inner_inverse[5], outer_inverse[5], stiffness[5], damping[5];
} Tilting;

static inline void slope_of_tilting(const Scene *p, const Tilting *q, const Geometry *g,
                                    const double *y, double *restrict f)
{
    const double ca = q->cos_angle, sa = q->sin_angle, A0 = q->groove_distance;
    const double w = p->cage_speed, k = p->load_deflection_factor;
    double x[5], v[5], sum[5] = {0.0, 0.0, 0.0, 0.0, 0.0};
    for (int i = 0; i < 5; i++) x[i] = y[i] - y[5 + i], v[i] = y[10 + i] - y[15 + i];
    const double v0 = v[0] + w * x[1], v1 = v[1] - w * x[0];
    const double v3 = v[3] + w * x[4], v4 = v[4] - w * x[3];
    const int n = (int)p->n_balls;
    for (int j = 0; j < n; j++) {
        const double c = g->c[j], s = g->s[j];
        const double radial = x[0] * c + x[1] * s - p->radial_clearance;
        const double axial = x[2] + x[3] * s - x[4] * c;
        const double along = fmax(A0 + radial * ca + axial * sa - g->d[j], 0.0);
        const double across = axial * ca - radial * sa;
        const double square = along * along + across * across;
        if (square <= A0 * A0) continue;
        const double A = sqrt(square), delta = A - A0;
        const double eu = along / A, ew = across / A;
        const double er = eu * ca - ew * sa, ez = eu * sa + ew * ca;
        const double rate = er * (v0 * c + v1 * s) + ez * (v[2] + v3 * s - v4 * c)
                            - eu * g->slope[j];
        const double push = k * delta * sqrt(delta) + p->contact_damping * rate;
        const double fr = push * er, fz = push * ez;
        sum[0] += fr * c, sum[1] += fr * s, sum[2] += fz, sum[3] += fz * s, sum[4] -= fz * c;
    }
    for (int i = 0; i < 10; i++) f[i] = y[10 + i];
    for (int i = 0; i < 5; i++) {
        f[10 + i] = (q->load[i] - sum[i]) * q->inner_inverse[i];
        f[15 + i] = (sum[i] - q->stiffness[i] * y[5 + i] - q->damping[i] * y[15 + i])
                    * q->outer_inverse[i];
    }
}

/* As `motion`: `y` (20), `states` (n, 20), `acceleration` (n, 5) of the outer ring. */
int motion_tilting(const Scene *p, const Tilting *q, double *restrict y, int n_samples, double step,
                   int nodes, double *restrict states, double *restrict acceleration)
{
    if (p->n_balls > LANES) return 2;
    Geometry *table = aligned_alloc(64, (nodes + 2) * sizeof(Geometry));
    if (!table) return 1;
    Scene without = *p;
    without.radial_clearance = 0.0; /* it does not lie along the line of contact */
    tabulate(&without, nodes, table);
    table[nodes + 1] = table[nodes];
    const double passes_a_step = p->cage_speed * step * p->n_balls / (2.0 * M_PI);
    Geometry start, middle, end;
    double k1[20], k2[20], k3[20], k4[20], t[20];
    look_up(table, nodes, 0.0, &start);
    for (int i = 0; i < n_samples; i++) {
        slope_of_tilting(p, q, &start, y, k1);
        for (int m = 0; m < 20; m++) states[20L * i + m] = y[m];
        for (int m = 0; m < 5; m++) acceleration[5L * i + m] = k1[15 + m];
        look_up(table, nodes, (i + 0.5) * passes_a_step, &middle);
        look_up(table, nodes, (i + 1.0) * passes_a_step, &end);
        for (int m = 0; m < 20; m++) t[m] = y[m] + 0.5 * step * k1[m];
        slope_of_tilting(p, q, &middle, t, k2);
        for (int m = 0; m < 20; m++) t[m] = y[m] + 0.5 * step * k2[m];
        slope_of_tilting(p, q, &middle, t, k3);
        for (int m = 0; m < 20; m++) t[m] = y[m] + step * k3[m];
        slope_of_tilting(p, q, &end, t, k4);
        for (int m = 0; m < 20; m++) y[m] += step / 6.0 * (k1[m] + 2.0 * (k2[m] + k3[m]) + k4[m]);
        start = end;
    }
    free(table);
    return 0;
}

/* The floor of the benchmarks: the package's arithmetic without Python, one step after the other.

   Quaternions scalar last, SI and radians. Where NumPy must work on whole arrays, C need not:
   attitudes are multiplied up one by one, and gravitation is found step by step. */

#include <math.h>

static inline void cross(const double *a, const double *b, double *c)
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static inline double square(const double *a) { return a[0] * a[0] + a[1] * a[1] + a[2] * a[2]; }

static inline void multiply(const double *a, const double *b, double *q)
{
    double x = a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1];
    double y = a[3] * b[1] + a[1] * b[3] + a[2] * b[0] - a[0] * b[2];
    double z = a[3] * b[2] + a[2] * b[3] + a[0] * b[1] - a[1] * b[0];
    double w = a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2];
    q[0] = x, q[1] = y, q[2] = z, q[3] = w;
}

static inline void rotate(const double *q, const double *v, double *out)
{
    double t[3], u[3];
    cross(q, v, t);
    for (int i = 0; i < 3; i++) t[i] *= 2;
    cross(q, t, u);
    for (int i = 0; i < 3; i++) out[i] = v[i] + q[3] * t[i] + u[i];
}

/* Attitude from increments: the last stage, the two algorithms, and their products. */

static inline void cayley(const double *k, double *q)
{
    double norm = square(k), scale = 1 / (1 + norm);
    for (int i = 0; i < 3; i++) q[i] = -2 * k[i] * scale;
    q[3] = (1 - norm) * scale;
}

static inline void picard_1(const double *g, double *q)
{
    double k[3];
    for (int i = 0; i < 3; i++) k[i] = -0.25 * g[i];
    cayley(k, q);
}

static inline void two_step_4(const double *g, double *q)
{
    double f[3], k[3], coning[3];
    cross(g, g + 3, coning);
    for (int i = 0; i < 3; i++) f[i] = g[i] + g[3 + i] + 2.0 / 3 * coning[i];
    double scale = -0.25 - square(f) / 192;
    for (int i = 0; i < 3; i++) k[i] = scale * f[i];
    cayley(k, q);
}

#define ATTITUDE(algorithm, samples) \
    void attitude_##algorithm(long steps, const double *g, double *q) \
    { \
        double now[4] = {0, 0, 0, 1}, turn[4]; \
        for (long s = 0; s < steps; s++) { \
            algorithm(g + 3 * samples * s, turn); \
            multiply(now, turn, now); \
            for (int i = 0; i < 4; i++) q[4 * s + i] = now[i]; \
        } \
    }

ATTITUDE(picard_1, 1)
ATTITUDE(two_step_4, 2)

/* Navigation: see driftlab.core.strapdown and driftlab.core.earth. */

static const double RATE = 7.292115e-5, MAJOR = 6378137.0, FLAT = 1 / 298.257223563;
static const double EQUATOR = 9.7803253359, POLE = 9.8321849378;

static void geodetic(double rho, double z, double *sine, double *cosine, double *up, double *across)
{
    double e2 = FLAT * (2 - FLAT), minor = MAJOR * (1 - FLAT);
    double x = (1 - FLAT) * rho, y = z, size = sqrt(x * x + y * y), c = x / size, s = y / size;
    y = z + e2 / (1 - e2) * minor * (s * s * s);
    x = rho - e2 * MAJOR * (c * c * c);
    size = sqrt(x * x + y * y);
    *sine = y / size, *cosine = x / size;
    double inverse = sqrt(1 - e2 * *sine * *sine) / MAJOR;
    *up = rho * *cosine + z * *sine - MAJOR * MAJOR * inverse;
    *across = 1 / inverse;
}

static void gravitation(const double *p, double *g)
{
    double growth = (1 - FLAT) * POLE / EQUATOR - 1, bend = 2 * (POLE - EQUATOR) / MAJOR;
    double sine, cosine, altitude, across;
    geodetic(sqrt(p[0] * p[0] + p[1] * p[1]), p[2], &sine, &cosine, &altitude, &across);
    double squared = sine * sine;
    double surface = across * (EQUATOR / MAJOR) * (1 + growth * squared);
    double gradient = 2 * (1 + FLAT + 0.00344978650684) / MAJOR - 4 * FLAT / MAJOR * squared
                      - 3 / (MAJOR * MAJOR) * altitude;
    bend *= altitude;
    double inwards = surface * (1 - altitude * gradient) - bend * squared;
    double level = -inwards / (across + altitude) - RATE * RATE;
    g[0] = level * p[0], g[1] = level * p[1], g[2] = -(inwards + bend) * sine;
}

static void local_axes(double latitude, double longitude, double *q)
{
    const double quarter = 0.78539816339744830962;
    double tilt = quarter - latitude / 2, turn = quarter + longitude / 2;
    double st = sin(tilt), ct = cos(tilt), sl = sin(turn), cl = cos(turn);
    q[0] = cl * st, q[1] = sl * st, q[2] = sl * ct, q[3] = cl * ct;
}

static void push_of_pair(const double *g, const double *v, double *out)
{
    double a[3], b[3], p[3], sum[3], coning[3], sculling[3], once[3], twice[3], thrice[3], turned[3];
    cross(g, g + 3, coning);
    cross(g, v + 3, a);
    cross(v, g + 3, b);
    for (int i = 0; i < 3; i++) {
        p[i] = g[i] + g[3 + i] + 2.0 / 3 * coning[i];
        sum[i] = v[i] + v[3 + i];
        sculling[i] = 2.0 / 3 * (a[i] + b[i]);
    }
    cross(p, sum, once);
    cross(p, once, twice);
    cross(p, twice, thrice);
    cross(p, sculling, turned);
    for (int i = 0; i < 3; i++)
        out[i] = sum[i] + once[i] / 2 + twice[i] / 6 + thrice[i] / 24 + sculling[i] + turned[i] / 2;
}

/* start: latitude, longitude, altitude, velocity (3), attitude (4). Each row of found (steps, 10)
   has the same after a pair of increments. */
void navigate(
    long steps, double interval, const double *angle, const double *velocity, const double *start,
    double *found)
{
    const double pi = 3.14159265358979323846;
    double e2 = FLAT * (2 - FLAT), sine = sin(start[0]), cosine = cos(start[0]), dt = 2 * interval;
    double across = MAJOR / sqrt(1 - e2 * sine * sine), axes[4], q[4], turn[4], push[3];
    double x[3], v[3], g[3], next[3], there[3];
    local_axes(start[0], 0, axes);
    multiply(axes, start + 6, q);
    x[0] = (across + start[2]) * cosine, x[1] = 0;
    x[2] = (across * (1 - e2) + start[2]) * sine;
    rotate(axes, start + 3, v);
    v[1] += RATE * x[0];
    gravitation(x, g);
    for (long s = 0; s < steps; s++) {
        const double *here = angle + 6 * s;
        double pushed[3];
        push_of_pair(here, velocity + 6 * s, push);
        rotate(q, push, pushed);
        two_step_4(here, turn);
        multiply(q, turn, q);
        /* The trapezoid rule for both sums; its gravitation is at the place that the old one gives,
           a hair away. */
        for (int i = 0; i < 3; i++) next[i] = x[i] + dt * (v[i] + 0.5 * (pushed[i] + dt * g[i]));
        gravitation(next, there);
        for (int i = 0; i < 3; i++) {
            double faster = v[i] + pushed[i] + 0.5 * dt * (g[i] + there[i]);
            x[i] += 0.5 * dt * (v[i] + faster);
            v[i] = faster, g[i] = there[i];
        }
        double up, radius, back[4], *row = found + 10 * s, level[3] = {v[0], v[1], v[2]};
        geodetic(sqrt(x[0] * x[0] + x[1] * x[1]), x[2], &sine, &cosine, &up, &radius);
        double longitude = atan2(x[1], x[0]);
        row[0] = atan2(sine, cosine), row[2] = up;
        row[1] = fmod(start[1] + longitude - RATE * dt * (s + 1) + pi, 2 * pi);
        row[1] += row[1] < 0 ? pi : -pi;
        local_axes(row[0], longitude, back);
        for (int i = 0; i < 3; i++) back[i] = -back[i];
        level[0] += RATE * x[1], level[1] -= RATE * x[0];
        rotate(back, level, row + 3);
        multiply(back, q, row + 6);
    }
}

/* Kalman filter: n states of which the first k move, three measurements; in place.
   phi (steps, k, n), q (k, k), h (3, n), r (3, 3), z (3), correction (n). */

enum { STATES = 27, MOVING = 6, SEEN = 3 };

static void predict(double P[STATES][STATES], const double (*phi)[STATES], const double (*q)[MOVING])
{
    double rows[MOVING][STATES] = {{0}};
    for (int i = 0; i < MOVING; i++)
        for (int j = 0; j < STATES; j++)
            for (int m = 0; m < STATES; m++) rows[i][m] += phi[i][j] * P[j][m];
    for (int i = 0; i < MOVING; i++) {
        for (int m = MOVING; m < STATES; m++) P[i][m] = P[m][i] = rows[i][m];
        for (int j = 0; j < MOVING; j++) {
            double sum = q[i][j];
            for (int m = 0; m < STATES; m++) sum += rows[i][m] * phi[j][m];
            P[i][j] = sum;
        }
    }
}

static void correct(
    double P[STATES][STATES], const double (*h)[STATES], const double (*r)[SEEN], const double *z,
    double *correction)
{
    double seen[SEEN][STATES] = {{0}}, s[SEEN][SEEN], w[SEEN][SEEN], gain[STATES][SEEN];
    for (int i = 0; i < SEEN; i++)
        for (int j = 0; j < STATES; j++)
            for (int m = 0; m < STATES; m++) seen[i][m] += h[i][j] * P[j][m];
    for (int i = 0; i < SEEN; i++)
        for (int j = 0; j < SEEN; j++) {
            s[i][j] = r[i][j];
            for (int m = 0; m < STATES; m++) s[i][j] += seen[i][m] * h[j][m];
        }
    cross(s[1], s[2], w[0]), cross(s[2], s[0], w[1]), cross(s[0], s[1], w[2]);
    double determinant = s[0][0] * w[0][0] + s[0][1] * w[0][1] + s[0][2] * w[0][2];
    for (int m = 0; m < STATES; m++) {
        correction[m] = 0;
        for (int j = 0; j < SEEN; j++) {
            gain[m][j] = (seen[0][m] * w[j][0] + seen[1][m] * w[j][1] + seen[2][m] * w[j][2])
                         / determinant;
            correction[m] += gain[m][j] * z[j];
        }
    }
    for (int i = 0; i < STATES; i++)
        for (int m = 0; m < STATES; m++)
            P[i][m] -= gain[i][0] * seen[0][m] + gain[i][1] * seen[1][m] + gain[i][2] * seen[2][m];
    for (int i = 0; i < STATES; i++)
        for (int m = 0; m < i; m++) P[i][m] = P[m][i] = 0.5 * (P[i][m] + P[m][i]);
}

void filter(
    long steps, double *P, const double *phi, const double *q, const double *h, const double *r,
    const double *z, double *correction)
{
    for (long i = 0; i < steps; i++) {
        predict((void *)P, (const void *)(phi + i * MOVING * STATES), (const void *)q);
        correct((void *)P, (const void *)h, (const void *)r, z, correction);
    }
}

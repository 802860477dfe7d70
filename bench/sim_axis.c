/* The axis of sim.py once more, as a person would write it in C: the same law, machine and command, row by row. */
#include <math.h>

typedef struct { double keep, kick, coulomb, stiction; } Mass;

static double after(const Mass *mass, double speed, double push) {
    double dry, next;
    if (speed == 0.0) {
        if (fabs(push) <= mass->stiction) return 0.0;
        dry = copysign(mass->coulomb, push);
    } else {
        dry = copysign(mass->coulomb, speed);
    }
    next = mass->keep * speed + mass->kick * (push - dry);
    if (next * dry < 0.0) return fabs(push) > mass->stiction ? next * (push + dry) / (push - dry) : 0.0;
    return next;
}

static double counted(double position, double count, double counts) {
    const double whole = 6755399441055744.0;
    return (position * counts + whole - whole) * count;
}

static double stretch(double gap, double twist, double half) {
    double to, from;
    if (fabs(twist) - fabs(half) >= gap) return twist - copysign(gap, twist);
    if (fabs(twist) + fabs(half) <= gap) return 0.0;
    to = fmax(fabs(twist + half) - gap, 0.0), from = fmax(fabs(twist - half) - gap, 0.0);
    return 0.25 * (to * to - from * from) / half;
}

static void command(const double *piece, double time, double *position, double *velocity) {
    double t = time - piece[0], v = piece[3], a = piece[4], j = piece[5];
    *position = piece[2] + t * (v + t * (0.5 * a + t * j * (1.0 / 6.0)));
    *velocity = v + t * (a + 0.5 * t * j);
}

typedef struct { double xm, vm, xl, vl, torque; } State;

/* The axis h seconds later; m: as machine.py lays it out, over such a step. */
static inline void advance(State *s, const double *m, double target, double h) {
    const Mass motor_mass = {m[4], m[5], m[6], m[7]}, load_mass = {m[8], m[9], m[10], m[11]};
    double mean, weight, stretched, coupling = 0.0;
    if (target > m[25]) target = m[25];
    else if (target < -m[26]) target = -m[26];
    mean = target + (s->torque - target) * m[21];
    s->torque = target + (s->torque - target) * m[20];
    s->xm += 0.5 * h * s->vm;
    s->xl += 0.5 * h * s->vl;
    weight = -m[17] - m[18] * s->xl;
    stretched = stretch(m[14], s->xm - s->xl, 0.5 * h * (s->vm - s->vl));
    if (stretched != 0.0) {
        coupling = m[12] * stretched + (m[13] * (s->vm - s->vl) - m[16] * weight);
        coupling += m[15] * mean;
        if (m[14] > 0.0 && coupling * stretched < 0.0) coupling = 0.0;
    }
    s->vm = after(&motor_mass, s->vm, mean - coupling);
    s->vl = after(&load_mass, s->vl, coupling + weight);
    s->xm += 0.5 * h * s->vm;
    s->xl += 0.5 * h * s->vl;
}

/* p: gain, velocity gain, integral gain, limit, velocity rate; m, before, late: the machine over a step and over its parts
   before and after a delayed output arrives; rows of 9 figures. */
long run(const double *p, const double *m, const double *before, const double *late, const double *profile, double period, long samples, long substeps,
         long stride, long most, double *rows) {
    State s = {0, 0, 0, 0, 0};
    double sum = 0, last = 0, output = 0, line[16] = {0};
    long slot = 0, delay = (long)m[22], length = delay + 2, row = 0, since = stride;
    double h = period / (double)(samples * substeps), clock = 0;
    for (long n = 0;; n++, clock += period) {
        double start = (double)n * period, now, velocity, wanted;
        while (clock >= profile[0] + profile[1]) profile += 8;
        command(profile, clock, &now, &velocity);
        wanted = p[0] * (now - counted(s.xl, m[31], m[35])) + velocity;
        for (long k = 0; k < samples; k++) {
            double motor = counted(s.xm, m[30], m[34]), error = wanted - (motor - last) * p[4];
            last = motor;
            output = p[1] * error + sum;
            if (output > p[3]) output = p[3];
            else if (output < -p[3]) output = -p[3];
            else sum += p[2] * error;
            for (long j = 0; j < substeps; j++) {
                if (since == stride) {
                    double *r, at = (double)(k * substeps + j) * h;
                    const double *piece = profile;
                    if (row >= most) return row;
                    r = rows + 9 * row++;
                    since = 0;
                    while (clock + at >= piece[0] + piece[1]) piece += 8;
                    command(piece, clock + at, &now, &velocity);
                    r[0] = start + at, r[1] = now, r[2] = velocity, r[3] = s.xl;
                    r[4] = counted(s.xl, m[31], m[35]), r[5] = now - r[4], r[6] = s.vl, r[7] = output, r[8] = s.torque;
                }
                since++;
                line[slot] = output;
                long newer = slot >= delay ? slot - delay : slot - delay + length;
                long older = newer > 0 ? newer - 1 : length - 1;
                slot = slot + 1 < length ? slot + 1 : 0;
                if (m[23] > 0.0 && line[older] != line[newer]) {
                    advance(&s, before, line[older], m[23] * h);
                    advance(&s, late, line[newer], h - m[23] * h);
                } else advance(&s, m, line[newer], h);
            }
        }
    }
}

// The paper's time step, line by line: the whole ring, plain loops, no symmetry and no reordered memory. Two
// ghosts at either end of the rail spare its loop the remainders of a division.
// A literal port of the method's lines for comparison with the compiled kernels.
// Arguments: bays, steps, time step [s], dx [m], mass per metre [kg/m], EI [N m2], pad: k_inf [N/m], then three
// pairs of strength [N/m] and time [s]; block mass [kg]; boot: the same seven; wheel mass [kg], contact [N/m].
// Prints seconds per run, the sum of the last squared support forces and the last wheel displacement [m].
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

struct Law {
    double stiffness, strength[3], time[3];
};

static Law read_law(char **&argument) {
    Law law;
    law.stiffness = std::atof(*argument++);
    for (int j = 0; j < 3; ++j) {
        law.strength[j] = std::atof(*argument++);
        law.time[j] = std::atof(*argument++);
    }
    return law;
}

int main(int, char **argv) {
    char **argument = argv + 1;
    const int bays = std::atoi(*argument++), steps = std::atoi(*argument++);
    const double dt = std::atof(*argument++), dx = std::atof(*argument++);
    const double m = std::atof(*argument++), EI = std::atof(*argument++);
    const Law pad = read_law(argument);
    const double block_mass = std::atof(*argument++);
    const Law boot = read_law(argument);
    const double wheel_mass = std::atof(*argument++), contact = std::atof(*argument++);

    const int elements = 3 * bays;
    std::vector<double> ghosted(elements + 4), v(elements), b(bays), vb(bays), f(bays), g(bays);
    std::vector<double> pad_memory(3 * bays), boot_memory(3 * bays), record;
    record.reserve(static_cast<size_t>(steps / 16 + 1) * bays);
    double *const a = ghosted.data() + 2;
    double w = 1e-4, vw = 0.0, energy = 0.0, pad_decay[3], boot_decay[3];
    for (int j = 0; j < 3; ++j) {
        pad_decay[j] = std::exp(-dt / pad.time[j]);
        boot_decay[j] = std::exp(-dt / boot.time[j]);
    }
    const auto began = std::chrono::steady_clock::now();
    for (int n = 0; n < steps; ++n) {
        const double rail = dt * EI / (m * dx * dx * dx * dx);
        a[-2] = a[elements - 2], a[-1] = a[elements - 1], a[elements] = a[0], a[elements + 1] = a[1];
        for (int i = 0; i < elements; ++i)
            v[i] -= rail * (a[i - 2] - 4 * a[i - 1] + 6 * a[i] - 4 * a[i + 1] + a[i + 2]);
        for (int s = 0; s < bays; ++s) {
            const double squeeze = a[3 * s] - b[s];
            f[s] = pad.stiffness * squeeze;
            g[s] = boot.stiffness * b[s];
            for (int j = 0; j < 3; ++j) {
                double &one = pad_memory[3 * s + j], &other = boot_memory[3 * s + j];
                one = one * pad_decay[j] + squeeze * dt;
                other = other * boot_decay[j] + b[s] * dt;
                f[s] -= pad.strength[j] * one / pad.time[j];
                g[s] -= boot.strength[j] * other / boot.time[j];
            }
            v[3 * s] -= dt * f[s] / (m * dx);
            vb[s] += dt * (f[s] - g[s]) / block_mass;
        }
        const double c = contact * (w - a[0]);
        vw -= dt * c / wheel_mass;
        v[0] += dt * c / (m * dx);
        if (n % 16 == 0) record.insert(record.end(), g.begin(), g.end());
        for (int i = 0; i < elements; ++i) a[i] += dt * v[i];
        for (int s = 0; s < bays; ++s) b[s] += dt * vb[s];
        w += dt * vw;
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - began;
    for (int s = 0; s < bays; ++s) energy += g[s] * g[s];
    std::printf("%.9g %.15g %.15g\n", seconds.count(), energy, w);
}

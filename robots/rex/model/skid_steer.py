#!/usr/bin/env python3
"""Writes skid_steer.c and skid_steer.h: the model of robots/rex/model.hpp and its derivatives, by CasADi.

Usage: skid_steer.py FOLDER, with CasADi's own folder on PYTHONPATH. Equal inputs give equal files.
"""
import sys

import casadi as ca

x = ca.SX.sym("x", 10)  # pose of the mass centre on M, velocity along the body, speeds of the wheels
u = ca.SX.sym("u", 4)  # torques at the wheels
p = ca.SX.sym("p", 3)  # mu_x, mu_y, split
d = ca.SX.sym("d", 14)  # all other numbers, below

mass, inertia, c_x, c_y, half_base, half_track, r, J, v_s, f_r = (d[k] for k in range(10))
N = d[10:14]  # vertical forces on the wheels
phi, v_x, v_y, w = (x[k] for k in range(2, 6))
omega = x[6:10]
mu_x, mu_y, split = (p[k] for k in range(3))

force_x = force_y = moment = 0
wheel_acceleration = []
for i, (front, left) in enumerate(((1, 1), (1, -1), (-1, 1), (-1, -1))):
    a, b = front * half_base - c_x, left * half_track - c_y
    s_x = v_x - b * w - r * omega[i]
    s_y = v_y + a * w
    n = ca.sqrt(s_x**2 + s_y**2 + v_s**2)
    k = 1 + left * split
    F_x = -mu_x * k * N[i] * s_x / n
    F_y = -mu_y * k * N[i] * s_y / n
    force_x += F_x
    force_y += F_y
    moment += a * F_y - b * F_x
    wheel_acceleration.append((u[i] - r * F_x - f_r * omega[i]) / J)

f = ca.vertcat(
    v_x * ca.cos(phi) - v_y * ca.sin(phi),
    v_x * ca.sin(phi) + v_y * ca.cos(phi),
    w,
    force_x / mass + v_y * w,
    force_y / mass - v_x * w,
    moment / inertia,
    *wheel_acceleration,
)
derivatives = [ca.densify(ca.jacobian(f, v)) for v in (x, u, p)]
generator = ca.CodeGenerator("skid_steer.c", {"with_header": True})
generator.add(ca.Function("skid_steer", [x, u, p, d], [f, *derivatives]))
generator.generate(sys.argv[1] + "/")

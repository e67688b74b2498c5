"""Sign flips and dropped terms in the kernels, and the tests that should notice each."""

from dataclasses import dataclass

HEART = "tests/heart"
ELEMENTS, MUSCLE = f"{HEART}/finite_elements", f"{HEART}/muscle"
CIRCULATION, ACTIVATION = f"{HEART}/circulation", f"{HEART}/activation"
BODY, BCS = f"{ELEMENTS}/test_body.py", f"{MUSCLE}/test_bcs.py"
MOONEY, EXPONENTIAL = f"{MUSCLE}/test_mooney_rivlin.py", f"{MUSCLE}/test_guccione.py"
SPHERE, TIME = f"{HEART}/sphere/test_sphere.py", f"{HEART}/test_time_step.py"
COMPILED = f"{HEART}/sphere/test_simulation.py"
SWITCHED_OFF = "tests/mechanisms/test_mechanisms.py::test_muscle_that_is_switched_off_is_the_same_muscle"
CAVITY, EIKONAL = "tests/geometry/test_cavity.py", f"{ACTIVATION}/test_eikonal.py"
UNSCENTED, UPDATE = "tests/calibration/test_unscented.py", "tests/calibration/test_update.py"


@dataclass(frozen=True)
class Mutant:
    """In ``file``, below the package, ``old`` becomes ``new``; ``tests`` should fail."""

    what: str
    file: str
    old: str
    new: str
    tests: str


def _in(file: str, tests: str, *changes: tuple[str, str, str]) -> tuple[Mutant, ...]:
    return tuple(Mutant(what, file, old, new, tests) for what, old, new in changes)


MUTANTS = (
    *_in(
        "heart/muscle/bcs.py",
        BCS,
        (
            "destruction by motion dropped",
            "x, formed = dt * rate + alpha * abs(d),",
            "x, formed = dt * rate,",
        ),
        (
            "motion mends bridges",
            "shrink = 1.0 / (1.0 + 0.25 * (dt * rate + alpha",
            "shrink = 1.0 / (1.0 + 0.25 * (dt * rate - alpha",
        ),
        (
            "bridges attach without tension",
            "formed * sigma_0 * inverse, 0.25",
            "0.0 * sigma_0 * inverse, 0.25",
        ),
        ("attaching bridges share no stress", "abs(d)) + loss)", "abs(d)))"),
        ("friction pushes", "tau + mu * d / dt - c,", "tau - mu * d / dt - c,"),
        ("friction of a relaxed sarcomere is zero", "mu * (rest + (1.0 - rest) * bound)", "mu * bound"),
        ("friction without its slope", "(mu + mu_d * d) / dt - c_d", "mu / dt - c_d"),
        ("fibre slope without the sarcomere", "change, s_e + s_d * increment_slope, d", "change, s_e, d"),
        ("lambda ends at its mean", "new[2, i] = 2.0 * mean - lam", "new[2, i] = mean"),
    ),
    *_in(
        "heart/muscle/spring.py",
        BCS,
        ("spring pulled by the old strain", "mean = 0.5 * (es_old + es_new)", "mean = es_old"),
    ),
    *_in(
        "heart/muscle/passive.py",
        MOONEY,
        ("first invariant not isochoric", "a * (identity - I1 / 3.0 * Ci[i])", "a * identity"),
        ("second invariant's sign", "(I1 * identity - C[e, i] -", "(I1 * identity + C[e, i] -"),
        ("tangent lacks the I2 term", " + 2.0 / 3.0 * I2 * odot)", ")"),
        ("in-plane stress lacks the radial part", "(stretch - stretch**-5)", "(stretch)"),
    ),
    *_in(
        "heart/muscle/guccione.py",
        EXPONENTIAL,
        ("not isochoric", "(H[i] - trace / 3.0 * Ci[i])", "H[i]"),
        ("tangent of the exponential halved", "2.0 * H[i] * H[k] +", "H[i] * H[k] +"),
        ("fibres do not mix", "0.5 * b[1] * mixed + b[2] * unit", "b[2] * unit"),
    ),
    *_in(
        "heart/finite_elements/kinematics.py",
        f"{ELEMENTS}/test_kinematics.py {BODY}",
        ("determinant's sign", "- F[e, 0, 1] * (F[e, 1, 0]", "+ F[e, 0, 1] * (F[e, 1, 0]"),
        ("inverse's shear", "out[3] = (C[4] * C[5] - C[3] * C[2])", "out[3] = (C[4] * C[5] + C[3] * C[2])"),
        ("fibre strain without shear", "e[i] = 0.5 * (normal - 1.0) + shear", "e[i] = 0.5 * (normal - 1.0)"),
        (
            "symmetric product not symmetric",
            "0.5 * (A[VOIGT[r, k]] * A[VOIGT[c, m]] + A[VOIGT[r, m]] * A[VOIGT[c, k]])",
            "A[VOIGT[r, k]] * A[VOIGT[c, m]]",
        ),
    ),
    *_in(
        "heart/finite_elements/assembly.py",
        BODY,
        (
            "wall pressure inwards",
            "S[e, i] += p[e] * J[e] * Ci[i] + viscous",
            "S[e, i] += -p[e] * J[e] * Ci[i] + viscous",
        ),
        ("matrix not viscous", " + viscous + tension[e]", " + tension[e]"),
        (
            "tangent of the pressure dropped",
            "volumetric = a * Ci[i] * Ci[j] - b * symmetric_product(Ci, i, j)",
            "volumetric = a * Ci[i] * Ci[j]",
        ),
        (
            "a shear in the wrong row",
            "P[i, 2] = F[e, i, 0] * S[e, 4] + F[e, i, 1] * S[e, 5]",
            "P[i, 2] = F[e, i, 0] * S[e, 5] + F[e, i, 1] * S[e, 4]",
        ),
        ("no geometric stiffness", "        _add_geometric(S[e], gradients[e], K)\n", ""),
    ),
    *_in(
        "heart/finite_elements/elements.py",
        f"{ELEMENTS}/test_elements.py {BODY}",
        (
            "no stabilisation",
            "CONSISTENT_MASS / K + PROJECTION_DEFECT / G",
            "CONSISTENT_MASS / K + 0.0 * PROJECTION_DEFECT / G",
        ),
        ("compressible the wrong way", "value -= compliance[a, b]", "value += compliance[a, b]"),
        (
            "pressure rows not coupled",
            "out[e, 4 * b + 3, 4 * a + i] = coupling",
            "out[e, 4 * b + 3, 4 * a + i] = 0.0",
        ),
    ),
    *_in(
        "heart/finite_elements/body.py",
        BODY,
        ("supports push", "self._support, x[:, :3]) - self._drag", "self._support, x[:, :3]) + self._drag"),
        (
            "tangent without the memory of the step",
            "(1.0 + self.time_step.memory) * self._fibre[1]",
            "self._fibre[1]",
        ),
    ),
    *_in(
        "heart/time_step.py",
        TIME,
        ("first order again", "self.length / (self.length + self.last) if", "0.0 * self.length if"),
        (
            "extrapolated backwards",
            "(1.0 + self.memory) * mean - self.memory * before",
            "(1.0 + self.memory) * mean + self.memory * before",
        ),
    ),
    *_in(
        "heart/muscle/tissue.py",
        f"{MUSCLE}/test_support.py",
        (
            "the pericardium sticks",
            "moduli[:, None, None] * unit[:, :, None] * unit[:, None, :]",
            "moduli[:, None, None] * np.eye(3)",
        ),
        ("no stiffer apex", "(1.0 + (self.apical - 1.0) * ramp)", "(1.0 + 0.0 * ramp)"),
    ),
    *_in(
        "heart/finite_elements/solver.py",
        f"{ELEMENTS}/test_solver.py",
        (
            "children are forgotten",
            "update[start:end, :end] -= np.dot(",
            "update[start:end, :end] += np.dot(",
        ),
        ("no substitution downwards", "            x -= np.dot(gathered, coupling)\n", ""),
        ("scaled once only", "result[i, j] *= scale[i] * scale[j]", "result[i, j] *= scale[i]"),
    ),
    *_in(
        "heart/finite_elements/unloading.py",
        f"{ELEMENTS}/test_statics_unloading.py::test_the_tangent_at_fixed_loaded_positions_is_exact_but_for_the_supports",
        (
            "loaded positions move",
            'np.einsum("eai,ebj->eaibj", forces, slopes)',
            '0.0 * np.einsum("eai,ebj->eaibj", forces, slopes)',
        ),
        ("not pulled back", 'np.einsum("eaibk,ekj->eaibj", blocks[..., :3], F)', "blocks[..., :3]"),
    ),
    *_in(
        "heart/sphere/body.py",
        SPHERE,
        ("fibres without leverage", "viscous + stretch * self._tension()[0]", "viscous + self._tension()[0]"),
        ("radial viscosity's sign", "plane * stretch - 2.0 * radial", "plane * stretch + 2.0 * radial"),
        ("wall does not thin", "slope *= 1.0 + 2.0 * ratio * stretch**-3", "slope *= 1.0"),
    ),
    *_in(
        "geometry/cavity.py",
        CAVITY,
        ("volume's sign", "return six_volumes / 6.0", "return -six_volumes / 6.0"),
        (
            "lids carry no pressure",
            "gradient[rim[i], axis] += gradient[-1 - opening, axis] / size",
            "gradient[rim[i], axis] += 0.0",
        ),
        ("gradient doubled", "gradient[a, i] -= cross / 6.0", "gradient[a, i] -= cross / 3.0"),
    ),
    *_in(
        "heart/activation/eikonal.py",
        EIKONAL,
        ("speed across not squared", "(np.eye(3) - along) / ratio**2", "(np.eye(3) - along) / ratio"),
        ("the earlier root", "(b + np.sqrt(discriminant)) / a", "(b - np.sqrt(discriminant)) / a"),
        (
            "rays from outside",
            "        return np.inf\n    return arrival",
            "        return arrival\n    return arrival",
        ),
    ),
    *_in(
        "heart/circulation/elements.py",
        f"{CIRCULATION}/test_windkessel.py",
        ("no run-off", "/ (1.0 + dt / tau), (q_L", ", (q_L"),
        ("venous pressure dropped", "(inflow + P_ve / R_p)", "inflow"),
        ("no inertance", " - Z_c * q_L / (1.0 + theta)", ""),
    ),
    *_in(
        "roles/laws.py",
        f"{CIRCULATION}/test_valves.py",
        ("valves open backwards", "way = 0 if drop > 0.0 else 2", "way = 0 if drop < 0.0 else 2"),
        (
            "slope of the orifice",
            "(0.5 * drop * drop + SMOOTHING * SMOOTHING) / smooth",
            "(drop * drop + SMOOTHING * SMOOTHING) / smooth",
        ),
        ("blood weighs half", "np.sqrt(2.0 / BLOOD_DENSITY)", "np.sqrt(4.0 / BLOOD_DENSITY)"),
    ),
    *_in(
        "roles/laws.py",
        f"{CIRCULATION}/test_narrowing.py",
        ("a narrowing takes a quarter", "np.sqrt(1.0 + 4.0 * laws", "np.sqrt(1.0 + laws"),
        (
            "a narrowed orifice as wide",
            "self.area / np.sqrt(1.0 + inverse_square",
            "self.area / np.sqrt(1.0 + 0.0",
        ),
    ),
    *_in(
        "roles/laws.py",
        f"{CIRCULATION}/test_enclosure.py",
        ("a load's slope without its scale", "slope += rise / scale", "slope += rise"),
    ),
    *_in(
        "heart/circulation/enclosure.py",
        f"{CIRCULATION}/test_enclosure.py",
        ("loads pull", "self._step.forces(x) + self._body", "self._step.forces(x) - self._body"),
        (
            "a load of rank none",
            "self._softened = softened / (1.0 + w @ softened)",
            "self._softened = 0.0 * u",
        ),
    ),
    *_in(
        "roles/laws.py",
        f"{CIRCULATION}/test_leaflets.py",
        ("leaflets close at the rate of opening", "1.0 - closing * drop", "1.0 - opening * drop"),
        ("open leaflets stop backflow", "leak - zeta * flow", "leak"),
        ("slope without the motion of the leaflets", "slope + rise * move", "slope + 0.0 * move"),
        (
            "backward slope of open leaflets dropped",
            "leak_slope + zeta * slope, -flow",
            "leak_slope, -flow",
        ),
    ),
    *_in(
        "heart/circulation/network.py",
        COMPILED,
        ("no waves in the arteries", "rows[:, 0] += self._arterial", "rows[:, 0] += 0.0"),
    ),
    *_in(
        "heart/sphere/beat.py",
        f"{CIRCULATION}/test_enclosure.py",
        ("nothing presses on spheres", "p[v] += pressure", "p[v] += 0.0 * pressure"),
    ),
    *_in(
        "heart/sphere/step.py",
        COMPILED,
        (
            "the Windkessel takes the wave for flow",
            "(p[count + v] - waves[n, v] - a) / b",
            "(p[count + v] - a) / b",
        ),
    ),
    *_in(
        "heart/circulation/circuit.py",
        f"{CIRCULATION}/test_circuit.py",
        ("compliance forgotten", "residual += storage * (p[j] - system[j, REFERENCE])", "residual += 0.0"),
        ("the full step in any case", "            share *= 0.5\n", ""),
    ),
    *_in(
        "calibration/unscented.py",
        UNSCENTED,
        ("deviations from the centre, not the mean", "deviation = z - mean", "deviation = z - z[0]"),
    ),
    *_in(
        "calibration/design.py",
        UNSCENTED,
        ("points too near", "np.sqrt(self.spread(n)) *", "1.0 *"),
        ("no extra weight of the centre", "covariance[0] += 1 - self.a**2 + self.b", "covariance[0] += 0.0"),
        (
            "a lost point repeats its partner",
            "up[~has_up] = 2.0 * filled[0] - down[~has_up]",
            "up[~has_up] = down[~has_up]",
        ),
    ),
    *_in(
        "calibration/design.py",
        "tests/calibration/test_simplex.py",
        (
            "corners too near",
            "1.0 / np.sqrt((j + 1) * (j + 2) * weight)",
            "0.5 / np.sqrt((j + 1) * (j + 2) * weight)",
        ),
        ("a lost corner is the centre", "filled[index] = corners * z[0] - ", "filled[index] = z[0] - 0.0 * "),
    ),
    *_in(
        "calibration/alternatives.py",
        "tests/calibration/test_iterated.py",
        ("the prior moves along", "(prior.mean - around.mean) @ slope", "0.0 * prior.mean @ slope"),
        ("points never shrink", "spread *= shrink**2", "spread *= 1.0"),
    ),
    *_in(
        "calibration/alternatives.py",
        "tests/calibration/test_alternatives.py",
        ("noise not inflated", "np.sqrt(assimilations) * np.linalg", "1.0 * np.linalg"),
    ),
    *_in(
        "calibration/update.py",
        UPDATE,
        ("the step backwards", "shift = gain @ (z - moments.mean)", "shift = gain @ (moments.mean - z)"),
        (
            "nothing is learnt",
            "covariance = prior.covariance - (gain",
            "covariance = prior.covariance - 0.0 * (gain",
        ),
    ),
    *_in(
        "heart/muscle/stiffened.py",
        f"{MUSCLE}/test_stiffened.py",
        ("an added energy not isochoric", "(A[i] - third * Ci[i])", "A[i]"),
        ("an added tangent without curvature", "b * slope[i] * slope[j] + a * bent", "a * bent"),
        ("a sphere's stiffening forgets its own bend", " + first * curve", ""),
    ),
    *_in(
        "heart/muscle/control.py",
        f"{MUSCLE}/test_control.py",
        ("a tail from the activation on", "np.maximum(duration - self.duration, 0.0)", "duration"),
        ("a tail hastens", "rate = rate - self.k_RS", "rate = rate + self.k_RS"),
    ),
    *_in(
        "heart/finite_elements/body.py",
        SWITCHED_OFF,
        ("nothing is late on a mesh", "tissue.delays()[reference.segments]", "0.0 * reference.segments"),
        ("nothing is scarred on a mesh", "1.0 - tissue.losses()", "1.0 - 0.0 * tissue.losses()"),
    ),
    *_in(
        "heart/sphere/step.py",
        SWITCHED_OFF,
        (
            "nothing is scarred in a compiled beat",
            "fibres[rows.KEPT, i] * available_fraction(",
            "1.0 * available_fraction(",
        ),
    ),
    *_in(
        "geometry/territory.py",
        "tests/geometry/test_territory.py",
        (
            "a territory does not fade",
            "(_reach(distance, share) - distance) / BORDER",
            "_reach(distance, share) - distance",
        ),
    ),
)

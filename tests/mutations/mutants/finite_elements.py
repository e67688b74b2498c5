"""Mutants of finite elements: kinematics, assembly, solver, unloading, time step."""

from tests.mutations.mutant import changes

ELEMENTS = "tests/heart/finite_elements"
BODY = f"{ELEMENTS}/test_body.py"
TIME = "tests/heart/test_time_step.py"

ELEMENT_MUTANTS = (
    *changes(
        "heart/finite_elements/kinematics.py",
        f"{ELEMENTS}/test_kinematics.py {BODY}",
        ("determinant's sign", "- b * (d * i - f * g)", "+ b * (d * i - f * g)"),
        ("inverse's shear", "per * (e * f - d * c)", "per * (e * f + d * c)"),
        ("fibre strain without shear", "0.5 * (normal - 1.0) + shear", "0.5 * (normal - 1.0)"),
        (
            "symmetric product not symmetric",
            "0.5 * (A[VOIGT[r, k]] * A[VOIGT[c, m]] + A[VOIGT[r, m]] * A[VOIGT[c, k]])",
            "A[VOIGT[r, k]] * A[VOIGT[c, m]]",
        ),
    ),
    *changes(
        "heart/finite_elements/assembly.py",
        BODY,
        (
            "wall pressure inwards",
            "S[e, i] += volumetric * entry + viscosity",
            "S[e, i] += -volumetric * entry + viscosity",
        ),
        ("matrix not viscous", " + viscosity * (C[e, i] - start) + tension[e]", " + tension[e]"),
        (
            "tangent of the pressure dropped",
            "volumetric = a * Ci[i] * Ci[j] - b * symmetric_product(Ci, i, j)",
            "volumetric = a * Ci[i] * Ci[j]",
        ),
        (
            "a shear in the wrong row",
            "z = v * (f[i, 0] * s[4] + f[i, 1] * s[5]",
            "z = v * (f[i, 0] * s[5] + f[i, 1] * s[4]",
        ),
        ("no geometric stiffness", "        _add_geometric(S[e], gradients[e], K)\n", ""),
    ),
    *changes(
        "heart/finite_elements/elements.py",
        f"{ELEMENTS}/test_elements.py {BODY}",
        (
            "no stabilisation",
            "CONSISTENT_MASS / K + PROJECTION_DEFECT / G",
            "CONSISTENT_MASS / K + 0.0 * PROJECTION_DEFECT / G",
        ),
        ("compressible the wrong way", "(change - c[0] * p", "(change + c[0] * p"),
        (
            "pressure rows not coupled",
            "out[e, 4 * b + 3, 4 * a + i] = coupling",
            "out[e, 4 * b + 3, 4 * a + i] = 0.0",
        ),
    ),
    *changes(
        "heart/finite_elements/body.py",
        BODY,
        ("dampers push", "rate = 1.0 / self", "rate = -1.0 / self"),
        (
            "tangent without the memory of the step",
            "(1.0 + self.time_step.memory) * self._fibre[1]",
            "self._fibre[1]",
        ),
    ),
    *changes(
        "heart/time_step.py",
        TIME,
        ("first order again", "self.length / (self.length + self.last) if", "0.0 * self.length if"),
        (
            "extrapolated backwards",
            "(1.0 + self.memory) * mean - self.memory * before",
            "(1.0 + self.memory) * mean + self.memory * before",
        ),
    ),
    *changes(
        "heart/finite_elements/solver.py",
        f"{ELEMENTS}/test_solver.py",
        (
            "children are forgotten",
            "rest[start:end, :end] - np.dot(",
            "rest[start:end, :end] + np.dot(",
        ),
        ("no substitution downwards", "own[i] -= change[i]", "pass"),
        (
            "no substitution downwards for many columns",
            "            x -= np.dot(back.T, gathered)\n",
            "",
        ),
        (
            "a general matrix taken for symmetric",
            "np.dot(inverse, beside).T",
            "coupling",
        ),
        ("scaled once only", "result[i, j] *= scale[i] * scale[j]", "result[i, j] *= scale[i]"),
    ),
    *changes(
        "heart/finite_elements/unloading.py",
        f"{ELEMENTS}/test_statics_unloading.py::test_the_tangent_at_fixed_loaded_positions_is_exact_but_for_the_supports",
        (
            "loaded positions move",
            'np.einsum("eai,ebj->eaibj", forces, slopes)',
            '0.0 * np.einsum("eai,ebj->eaibj", forces, slopes)',
        ),
        ("not pulled back", 'np.einsum("eaibk,ekj->eaibj", blocks[..., :3], F)', "blocks[..., :3]"),
    ),
    *changes(
        "heart/tangent.py",
        "tests/heart/test_tangent.py",
        ("limit cycle not continued", " + (last.signals - first.signals) @ weights", ""),
        ("atria of neighbours ignored", "    if own != others:", "    if False:"),
    ),
    *changes(
        "heart/neighbourhood.py",
        "tests/heart/test_neighbourhood.py",
        ("no reference of its own", "not other.rests_like(wall)", "False"),
        ("stress-free walls unloaded", "    if unloaded:", "    if True:"),
    ),
    *changes(
        "heart/finite_elements/unloading.py",
        "tests/heart/test_neighbourhood.py",
        (
            "loads are not compared",
            "(wall.pressures, wall.tissue.stiffenings()",
            "(wall.tissue.stiffenings()",
        ),
        ("fibres are not compared", "wall.mesh.points, mean_dyads(wall.mesh))", "wall.mesh.points)"),
    ),
    *changes(
        "heart/finite_elements/body.py",
        "tests/heart/test_tangent.py",
        ("increment of the fibres kept", "        increment += increment_slope * change\n", ""),
    ),
)

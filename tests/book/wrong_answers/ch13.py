"""Wrong answers to the exercises of chapter 13."""

import sympy as sp

Psi, theta, gamma, phi, delta = sp.symbols("Psi theta gamma varphi delta", real=True)
U, g = sp.symbols("U g", positive=True)
d_x, d_z, a_x, a_y, a_z = sp.symbols("d_x d_z a_x a_y a_z", real=True)

right_alone = d_z / (U * sp.cos(phi) * sp.cos(Psi)) - a_z * sp.tan(phi) / (g * sp.cos(Psi))

WRONG = {
    "13.1": [
        ([0, 0.306], "from North to West"),
        ([-0.306, 0], "a drift about North does nothing"),
        ([0, -0.243], "sine of the latitude"),
        ([0, -0.19], "only its level part"),
        ([0, -0.00534], "asked in degrees"),
    ],
    "13.2": [
        ("abcd", r"^not yet. \(c\)"),
        ("abde", r"\(e\)"),
        ("ab", "something else is too"),
        ("ce", "^not yet. More than one statement"),
    ],
    "13.3": [
        (0, "true of a level box"),
        (sp.tan(theta) * a_z / g, "upper accelerometer"),
        (sp.tan(theta) * (a_z * sp.cos(gamma) - a_y * sp.sin(gamma)) / g, "Look at the sign"),
        (sp.tan(theta) * (a_z * sp.cos(gamma) + a_y * sp.sin(gamma)), "divided by g"),
        (
            sp.tan(theta)
            * (
                (a_z * sp.cos(gamma) + a_y * sp.sin(gamma))
                * (sp.cos(Psi) ** 2 + sp.sin(Psi) ** 2 * sp.tan(phi))
                + sp.sin(Psi)
                * sp.cos(Psi)
                * (sp.tan(phi) - 1)
                * (
                    a_x * sp.cos(theta)
                    + (a_z * sp.sin(gamma) - a_y * sp.cos(gamma)) * sp.sin(theta)
                )
            )
            / g,
            "paper's factor",
        ),
    ],
    "13.4": [
        (-41, "bow must be raised"),
        (65, "takes away"),
        (41, "helped each other"),
        (1.284, "asked in degrees"),
    ],
    "13.5": [
        (right_alone, "A wrong latitude"),
        (d_z / (U * sp.cos(phi)) - a_z * sp.tan(phi) / g, "heading zero only"),
        (right_alone - sp.tan(Psi) * sp.tan(phi) * delta, "farther North"),
        (
            -(d_x / (U * sp.cos(phi)) - a_x * sp.tan(phi) / g + sp.cos(Psi) * sp.tan(phi) * delta)
            / sp.sin(Psi),
            "without the right gyro",
        ),
    ],
    "13.6": [
        (100, r"^not yet\. Too small\.$"),
        (400, r"^not yet\. Too large\.$"),
        (114, "drift at the end"),
        (624, "Ten samples"),
        (1971, "number of samples"),
        (3.29, "asked in s"),
    ],
    "13.7": [
        (1150, r"^not yet\. Too small\.$"),
        (1400, r"^not yet\. Too large\.$"),
        (610.6, "time of one position"),
        (888.8, "after half a turn"),
        (748.7, "half of its error"),
        (1088, "change of the drifts counts"),
        (0.339, "asked in s"),
    ],
}

"""What the columns of a class's list are called, in the languages that we have met."""

from __future__ import annotations

FULL = (
    "name", "student", "full name", "fullname", "student name",
    "last name, first name", "name, vorname", "nachname, vorname", "nom, prénom",
    "vollständiger name", "nom complet", "фио", "студент", "полное имя",
)  # fmt: skip
FIRST = ("first name", "firstname", "given name", "vorname", "prénom", "prenom", "имя")
LAST = (
    "last name", "lastname", "surname", "family name",
    "nachname", "familienname", "nom", "nom de famille", "фамилия",
)  # fmt: skip
IDS = (
    "id", "id number", "student id", "student number", "number", "sis user id", "sis login id",
    "username", "login", "email", "email address", "e-mail", "e-mail address",
    "matrikelnummer", "id-nummer", "anmeldename", "nutzername", "e-mail-adresse",
    "numéro d'identification", "numéro d'étudiant", "nom d'utilisateur", "courriel",
    "adresse de courriel", "adresse e-mail",
    "индивидуальный номер", "номер", "логин", "адрес электронной почты", "электронная почта",
)  # fmt: skip


def columns(line: list[str]) -> tuple[list[int], list[int]]:
    """Return which cells of a heading are the parts of a name, and which tell who it is.

    Both are empty if the line is no heading.
    """
    head = [cell.casefold().replace("’", "'") for cell in line]
    full, first, last = (
        next((i for i, cell in enumerate(head) if cell in known), None)
        for known in (FULL, FIRST, LAST)
    )
    if first is not None and full is not None and head[full] == "name":
        last = full if last is None else last  # beside "Vorname" it is the family's
        full = None
    names = [full] if full is not None else [i for i in (first, last) if i is not None]
    return names, [i for i, cell in enumerate(head) if cell in IDS]

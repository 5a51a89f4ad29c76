"""The figures of the book, one module a picture.

Each module has ``compute(...)``, which returns plain arrays, a ``Picture`` whose ``draw(data)``
gives a Matplotlib figure and whose ``update(data)`` moves an existing one, and ``columns(data)``
for the CSV. `catalogue` lists what is published; ``python -m driftlab.figures`` rebuilds it all.
"""

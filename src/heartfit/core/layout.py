"""Layout of figures, computed once."""

from matplotlib.figure import Figure


def lay_out(figure: Figure) -> None:
    """Place the axes by the figure's layout engine, and remove it: with one, every picture is drawn twice."""
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.execute(figure)
        figure.set_layout_engine(None)

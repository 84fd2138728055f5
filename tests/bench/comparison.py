"""A run of the benchmarks beside a stored one: which ratios became worse."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

MOST = 1.3  # times as bad as stored, from which a row is told
Row = Mapping[str, object]


def worsened(stored: Mapping[str, Sequence[Row]], told: Mapping[str, Sequence[Row]], most: float = MOST) -> list[str]:
    """Returns one line for each row, by benchmark and name, whose ratio is more than `most` times as bad as stored:
    larger, or smaller where more is better.  Rows that only one of the two measured are not compared."""
    out = []
    for bench, rows in told.items():
        before = {row["name"]: row for row in stored.get(bench, ())}
        for row in rows:
            old, new = _ratio(before.get(row["name"], {})), _ratio(row)
            if old is None or new is None:
                continue
            worse, better = (old, new) if row["more_is_better"] else (new, old)
            if worse > most * better:
                times = f"{worse / better:.2f} x" if better else "beyond measure"
                out.append(f"{bench}: {row['name']}: ratio {new:.4g}, stored {old:.4g}: {times} worse")
    return out


def _ratio(row: Row) -> float | None:
    ratio = row.get("ratio")
    return float(ratio) if isinstance(ratio, int | float) else None

"""Which superpixels belong to what lies on the ground: the ground by the statistics of the picture's border, then
random walks with priors (Grady 2005), whose models of colour are learnt anew from what was found."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy import sparse
from scipy.sparse import csgraph
from scipy.sparse.linalg import spsolve

from engine.texture.mattes.patchwork import Patchwork

ROUNDS, AGAIN = 6, 3  # of learning the models: at first, and after a stroke
_PRIOR = 0.15  # how much a pixel's colour counts beside its neighbours
_SURE = 1e4  # what the artist said
_STROKED = 0.25  # the part of a model that strokes make up
_CLIP = 3.0  # of a logarithm of likelihoods
_RARE = 2e-3  # of any kind of colour, in every model
_FAINT = 0.004  # of the picture: what is smaller is none
_AS_GOOD = 0.005  # of two models: nearly as far apart as any
_RATHER, _SCATTERED = 0.5, 0.55  # how alike both are, and the part with ground beside it, of a texture
_MANY = 1000  # superpixels, from which on that tells anything
_SAME = 0.93  # of ground and the rest: more alike are one texture


class Belonging(NamedTuple):
    """`inside`: how far each superpixel belongs, float64 (n,) 0..1; `models`: how often each kind of colour comes
    inside and on the ground, (2, K); `whole`: the picture has no ground."""

    inside: np.ndarray
    models: np.ndarray
    whole: bool = False


def untouched(patches: Patchwork) -> Belonging:
    """Finds what belongs, without being told."""
    sure = np.where(patches.holes, -1.0, 0.0)
    ring = _ground(patches)
    if not ring.any() or patches.holes.all():
        return _everything(patches)
    looks = [np.where(patches.holes, 0.0, look) for look in _first_looks(patches, ring)]
    found = [_settled(patches, look, ring, sure, ROUNDS) for look in looks]
    least = min(map(_alike, found))
    best = next(one for one in found if _alike(one) <= least + _AS_GOOD)
    return _everything(patches) if _is_texture(patches, best) else best


def corrected(patches: Patchwork, before: Belonging, said: np.ndarray) -> Belonging:
    """Finds what belongs after the artist said of some superpixels, float64 (n,), that they do (1) or do not (-1)."""
    sure = np.where(patches.holes, -1.0, said)
    if not sure.any():
        return before
    ring = _ground(patches) * (said <= 0)
    inside = before.inside.copy()
    if before.whole:  # so the ground is what is like what was dropped, or unlike what was kept
        dropped = said < 0
        inside = _unlike(patches, dropped) if dropped.any() else 1.0 - _unlike(patches, said > 0)
        ring = ring * 0.0
    inside[sure > 0], inside[sure < 0] = 1.0, 0.0
    return _settled(patches, inside, ring, sure, AGAIN)


def _everything(patches: Patchwork) -> Belonging:
    models = np.full((2, patches.grained.shares.shape[1]), 1.0 / patches.grained.shares.shape[1])
    return Belonging(np.where(patches.holes, 0.0, 1.0), models, True)


def _ground(patches: Patchwork) -> np.ndarray:
    """Returns pixels at the border that are of the ground, of each superpixel: those unlike most of the border are
    something that lies across it."""
    ring = np.where(patches.holes, 0.0, patches.ring)
    for _ in range(3):
        if not ring.any():
            break
        likely = patches.grained.shares @ np.log(_model(patches, ring))
        there = likely[ring > 0]
        middle = np.median(there)
        spread = np.median(np.abs(there - middle)) + 0.15
        ring = np.where((likely > middle - 4.0 * spread) & ~patches.holes, patches.ring, 0.0)
    return ring


def _model(patches: Patchwork, weights: np.ndarray) -> np.ndarray:
    """Returns how often each kind of colour comes in superpixels of such weights: float64 (K,)."""
    counts = (weights @ patches.grained.shares) @ patches.grained.alike
    kinds = len(counts)
    total = counts.sum()
    found: np.ndarray = (1 - _RARE * kinds) * counts / total + _RARE if total > 0 else np.full(kinds, 1.0 / kinds)
    return found


def _first_looks(patches: Patchwork, ring: np.ndarray) -> list[np.ndarray]:
    """Tells in some ways how far each is from the ground: by how unlike that it is and how much is in the way from
    there; by how unlike its surroundings are, near and wide; by how far it is from the border."""
    ground = np.log(_model(patches, ring))
    odd, wide = (-(_pooled(patches, patches.grained.shares, times) @ ground) for times in (2, 16))
    sources = np.flatnonzero(ring)
    steps = patches.steps.copy()
    among = patches.steps[sources][:, sources].data
    usual = np.quantile(among, 0.9) if len(among) else 0.0
    steps.data = np.maximum(steps.data - usual, 1e-5)
    far = csgraph.dijkstra(steps, indices=sources, min_only=True)
    far = np.where(np.isfinite(far), far, far[np.isfinite(far)].max())
    inward = csgraph.dijkstra(patches.steps, indices=sources, min_only=True, unweighted=True)
    inward = np.where(np.isfinite(inward), inward, 0.0)
    both = 0.5 * (_split(odd, patches.areas) + _split(far, patches.areas))
    return [both, _split(wide, patches.areas), _split(inward, patches.areas)]


def _unlike(patches: Patchwork, marked: np.ndarray) -> np.ndarray:
    """Tells how unlike what was marked each is."""
    return _split(-(patches.grained.shares @ np.log(_model(patches, marked * patches.areas))), patches.areas)


def _pooled(patches: Patchwork, values: np.ndarray, times: int) -> np.ndarray:
    """Returns values (n, k) as means over neighbours and theirs."""
    mixing = (patches.graph + sparse.diags(np.asarray(patches.graph.sum(axis=1)).ravel() / 2 + 1e-9)).tocsr()
    mixing = sparse.diags(1.0 / np.asarray(mixing.sum(axis=1)).ravel()) @ mixing
    for _ in range(times):
        values = mixing @ values
    return values


def _split(values: np.ndarray, areas: np.ndarray) -> np.ndarray:
    """Returns 0..1 for values about the threshold that parts them best (Otsu 1979)."""
    order = np.argsort(values, kind="stable")
    value, area = values[order], areas[order]
    low, high = np.cumsum(area), area.sum() - np.cumsum(area)
    sums = np.cumsum(area * value)
    with np.errstate(divide="ignore", invalid="ignore"):
        between = low * high * (sums / low - (sums[-1] - sums) / high) ** 2
    at = int(np.nanargmax(between[:-1])) if len(value) > 1 else 0
    threshold = 0.5 * (value[at] + value[min(at + 1, len(value) - 1)])
    spread = 0.25 * (values.std() + 1e-9)
    found: np.ndarray = 1.0 / (1.0 + np.exp(np.clip(-(values - threshold) / spread, -30, 30)))
    return found


def _settled(patches: Patchwork, inside: np.ndarray, ring: np.ndarray, sure: np.ndarray, rounds: int) -> Belonging:
    """Learns models of what is inside and what is not, and walks, in turns."""
    laplacian = csgraph.laplacian(patches.graph).tocsr()
    models = np.zeros((2, patches.grained.shares.shape[1]))
    for _ in range(rounds):
        models = learnt(patches, inside, ring, sure)
        likely = np.clip(patches.grained.shares @ np.log(models[0] / models[1]), -_CLIP, _CLIP)
        belongs = 1.0 / (1.0 + np.exp(-2.0 * likely))
        weight = _PRIOR * patches.areas * np.abs(2.0 * belongs - 1.0)
        target = weight * (belongs > 0.5)
        weight = weight + _SURE * np.abs(sure) + 2.0 * ring + 1e-6
        target = target + _SURE * np.maximum(sure, 0.0) + 0.5e-6
        inside = np.clip(spsolve((laplacian + sparse.diags(weight)).tocsc(), target, "MMD_AT_PLUS_A"), 0.0, 1.0)
    return Belonging(inside, models)


def learnt(patches: Patchwork, inside: np.ndarray, ring: np.ndarray, sure: np.ndarray) -> np.ndarray:
    """Returns models of what is inside and of the ground, (2, K)."""
    found = []
    for weights, said in ((inside, sure > 0), (1.0 - inside, (sure < 0) & ~patches.holes)):
        held = np.where(patches.holes, 0.0, np.where(weights > 0.5, weights, 0.0) * patches.areas)
        model = _model(patches, held)
        if said.any():
            much = float(said @ patches.areas)
            part = _STROKED * much / (much + _FAINT * patches.areas.sum())
            model = (1 - part) * model + part * _model(patches, said * patches.areas)
        found.append(model)
    return np.array(found)


def _is_texture(patches: Patchwork, found: Belonging) -> bool:
    """Tells whether there is no ground: next to nothing lies on it, or what lies there is like it, or is in pieces all
    over it and not too unlike."""
    seen = patches.areas * ~patches.holes
    share = seen @ (found.inside > 0.5) / seen.sum()
    if share < _FAINT or share > 1 - _FAINT or _alike(found) > _SAME:
        return True
    return bool(patches.count > _MANY and _alike(found) > _RATHER and _scattered(patches, found) > _SCATTERED)


def _scattered(patches: Patchwork, found: Belonging) -> float:
    """Tells which part of what is inside has ground beside it, 0..1: near 1 for mortar, pebbles' shadows, leaves."""
    inside = found.inside > 0.5
    beside = (patches.steps > 0) @ (~inside).astype(np.float64) > 0
    area = patches.areas * inside
    return float(area @ beside / area.sum())


def _alike(found: Belonging) -> float:
    """Tells how alike the two models are, 0..1."""
    return float(np.sqrt(found.models[0] * found.models[1]).sum())

"""How a change rises: what it makes of the coarser levels, and of the residuals, where it changes anything."""

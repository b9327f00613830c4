"""Pictures: what draws, and knows neither server nor solver."""

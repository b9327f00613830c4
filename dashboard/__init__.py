"""The browser dashboard of trackig: what draws, and never solves.

Units shown are those of the trade (kN/mm, kg, m, Hz, dB); :mod:`dashboard.session.inputs` alone converts.
Data flow one way, controls to inputs to runner to outcome to views to figures.
"""

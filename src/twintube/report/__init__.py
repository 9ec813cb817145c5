"""Pages and pictures, a room for each command that shows them.

    diagnosis            `twintube diagnose`
    identification       `twintube identify`
    car                  `twintube car` and `python -m benchmarks car_sensitivity`
    inspection           `twintube inspect`
    paper                `twintube paper figures`
    monitor.py           `twintube monitor`
    simulated_record.py  `twintube simulate`
    plot.py              the method `plot()` of results
    common               what all pages share

Nothing is imported here: no command waits for the rooms of others.
"""
